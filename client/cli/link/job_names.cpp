#include "cli/link/job_names.h"

#include <string_view>

#include "base/ids.h"
#include "cli/base/assignments.h"

namespace contact::cli {

std::string JobName(const std::string& job) {
  return job.starts_with("jobs/") ? job : "jobs/" + job;
}

std::string ShortName(const std::string& name) {
  constexpr std::string_view kCollection = "jobs/";
  return name.starts_with(kCollection) ? name.substr(kCollection.size()) : name;
}

std::string RandomRequestId() { return RandomIds().NextUuid(); }

std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts) {
  return ParseAssignments(texts, "--label", "KEY=VALUE");
}

}  // namespace contact::cli
