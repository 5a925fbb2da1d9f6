#include "cli/link/job_names.h"

#include <fmt/format.h>

#include <random>
#include <string_view>

#include "cli/base/assignments.h"

namespace contact::cli {

std::string JobName(const std::string& job) {
  return job.starts_with("jobs/") ? job : "jobs/" + job;
}

std::string ShortName(const std::string& name) {
  constexpr std::string_view kCollection = "jobs/";
  return name.starts_with(kCollection) ? name.substr(kCollection.size()) : name;
}

std::string RandomRequestId() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts) {
  return ParseAssignments(texts, "--label", "KEY=VALUE");
}

}  // namespace contact::cli
