#include "cli/verbs/job/scenario_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "cli/base/message.h"
#include "cli/input/no_limits.h"
#include "cli/input/scenario_file.h"
#include "cli/input/sweep_file.h"
#include "cli/input/templates.h"
#include "cli/input/yaml_document.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/text/render_json.h"

namespace contact::cli {
namespace {

// Says so if a server of another version made the job: only the same version repeats it bit for
// bit.
void TellOfOtherServer(Client& client, const v1::Job& job) {
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  if (job.server_version().empty() ||
      (job.server_version() == info.version() && job.server_revision() == info.revision())) {
    return;
  }
  Tell("{} was made by contactd {} {}, this one is {} {}: last digits may differ\n", job.name(),
       job.server_version(), job.server_revision(), info.version(), info.revision());
}

// Throws Failure (kLocal) if there is no such file, but an example with this name.
void RequireNoTemplate(const std::string& file) {
  const auto shipped = std::ranges::find(Templates(), file, &Template::name);
  if (shipped == Templates().end() || std::filesystem::exists(file)) return;
  throw Failure(ExitCode::kLocal, fmt::format("there is no file {0} — --template {0} takes the "
                                              "example of this name",
                                              file));
}

}  // namespace

void ScenarioSource::AddTo(CommandLine& line, CLI::App& command) {
  AddOption(line, command, "FILE", &file_, ValueKind::kScenarioFile,
            "Scenario, or of submit a sweep, in YAML or JSON; - is the standard input");
  AddOption(line, command, "--like", &like_, ValueKind::kJob,
            "Repeat this job instead of a file; on the same server bit for bit");
  AddOption(line, command, "-t,--template", &template_, ValueKind::kTemplate,
            "Take what init would write, instead of a file");
  Repeatable(AddOption(line, command, "--set", &overrides_, ValueKind::kAssignment,
                       "Override a field, such as contacts[0].restitution=0.7; repeatable"));
  AddVariableFlag(command, &variables_);
}

ScenarioSource::Spec ScenarioSource::Open(Client& client) const {
  Spec spec = Read(client);
  if (auto* file = std::get_if<ScenarioFile>(&spec)) {
    return Checked(std::move(*file), overrides_, kNoLimits);
  }
  if (overrides_.empty()) return spec;
  throw Failure(ExitCode::kUsage, "--set is for scenarios; of a sweep change base and axes");
}

ScenarioFile ScenarioSource::OpenScenario(Client& client) const {
  Spec spec = Open(client);
  if (auto* file = std::get_if<ScenarioFile>(&spec)) return std::move(*file);
  if (!like_.empty()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{} is a sweep, not a run", FindJob(client, like_)));
  }
  throw Failure(
      ExitCode::kUsage,
      fmt::format("{0} is a sweep: `contactctl sweep run {1}{0}` shows its cells, `contactctl "
                  "submit {1}{0}` leaves it to the server",
                  template_.empty() ? file_ : template_, template_.empty() ? "" : "-t "));
}

ScenarioSource::Spec ScenarioSource::Read(Client& client) const {
  const std::array sources = {file_.empty(), like_.empty(), template_.empty()};
  if (std::ranges::count(sources, false) != 1) {
    throw Failure(ExitCode::kUsage, "give a FILE, --template NAME or --like JOB, one of them");
  }
  if (!template_.empty()) return ReadTemplate();
  if (!like_.empty()) return ReadJob(client);
  RequireNoTemplate(file_);
  const std::string text = ReadYaml(file_);
  if (IsSweep(text)) return ReadSweep(file_, text, ParseVariables(variables_));
  return ScenarioFile(file_ == "-" ? "<stdin>" : file_, text, ParseVariables(variables_),
                      std::filesystem::path(file_).parent_path().string());
}

ScenarioSource::Spec ScenarioSource::ReadJob(Client& client) const {
  const v1::Job job = GetJob(client, FindJob(client, like_));
  TellOfOtherServer(client, job);
  if (!job.has_sweep()) {
    return ScenarioFile(job.name(), ToJsonLine(job.scenario()), ParseVariables(variables_));
  }
  if (variables_.empty()) return job.sweep();
  throw Failure(ExitCode::kUsage,
                fmt::format("--var: {} is a job and has no variables", job.name()));
}

ScenarioSource::Spec ScenarioSource::ReadTemplate() const {
  const std::string text(FindTemplate(template_).text);
  if (IsSweep(text)) return ReadSweep(template_, text, ParseVariables(variables_), true);
  return ScenarioFile(template_, text, ParseVariables(variables_));
}

}  // namespace contact::cli
