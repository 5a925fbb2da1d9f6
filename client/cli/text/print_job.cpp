#include "cli/text/print_job.h"

#include <fmt/format.h>

#include "cli/text/render_job.h"
#include "cli/text/render_json.h"

namespace contact::cli {

void PrintJson(const std::string& json, const Settings& settings) {
  fmt::print("{}", settings.yaml ? YamlOfJson(json) : EscapedJson(json));
}

void PrintJob(const v1::Job& job, const Settings& settings,
              const std::vector<std::string>& columns) {
  if (settings.output == OutputFormat::kName) {
    fmt::print("{}\n", job.name());
  } else if (settings.output == OutputFormat::kJson) {
    PrintJson(ToJson(job), settings);
  } else {
    Style style = settings.OutputStyle();
    style.columns = columns;
    fmt::print("{}", RenderJob(job, style));
  }
}

ExitCode CodeOf(const v1::Job& job) {
  if (job.state() == v1::Job::FAILED || job.state() == v1::Job::CANCELLED) {
    return ExitCode::kRunFailed;
  }
  return job.convergence() == v1::Job::PARTIAL ? ExitCode::kNotConverged : ExitCode::kOk;
}

}  // namespace contact::cli
