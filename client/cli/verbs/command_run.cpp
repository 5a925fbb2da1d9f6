#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <memory>

#include "cli/input/checked_scenario.h"
#include "cli/input/no_limits.h"
#include "cli/input/sweep_file.h"
#include "cli/input/templates.h"
#include "cli/link/connect.h"
#include "cli/link/job_names.h"
#include "cli/link/job_source.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/job_options.h"
#include "cli/text/print_job.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/text/render_ledger.h"
#include "cli/verbs/follow.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct RunArguments {
  std::string file;
  std::string like;           ///< The job that is repeated instead of a file.
  std::string from_template;  ///< The shipped scenario that is taken instead of a file.
  std::vector<std::string> overrides;
  std::vector<std::string> variables;  ///< --var
  std::vector<std::string> labels;
  std::string request_id;
  JobOptions job;
  std::string rows = "first";  ///< Of the μ-iteration.
  bool cancel_on_interrupt = false;
  ColumnChoice columns;
};

v1::CreateJobRequest Request(const RunArguments& arguments, const v1::Scenario& scenario) {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_scenario() = scenario;
  request.set_request_id(arguments.request_id.empty() ? RandomRequestId() : arguments.request_id);
  for (const auto& [key, value] : ParseLabels(arguments.labels)) {
    (*request.mutable_job()->mutable_labels())[key] = value;
  }
  arguments.job.Apply(request.mutable_job());
  return request;
}

// The same bits are promised of the same server only.
void TellOfOtherServer(Client& client, const v1::Job& job) {
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  if (job.server_version().empty() ||
      (job.server_version() == info.version() && job.server_revision() == info.revision())) {
    return;
  }
  fmt::print(stderr, "{} was made by contactd {} {}, this one is {} {}: last digits may differ\n",
             job.name(), job.server_version(), job.server_revision(), info.version(),
             info.revision());
}

// The scenario of an earlier job, with the overrides.
ScenarioFile OpenLike(Client& client, const RunArguments& arguments) {
  const v1::Job job = GetJob(client, arguments.like);
  if (job.has_sweep()) {
    throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep, not a run", job.name()));
  }
  TellOfOtherServer(client, job);
  return Checked(
      ScenarioFile(job.name(), ToJsonLine(job.scenario()), ParseVariables(arguments.variables)),
      arguments.overrides, kNoLimits);
}

ScenarioFile OpenTemplate(const RunArguments& arguments) {
  const Template& scenario = FindTemplate(arguments.from_template);
  const std::string text(scenario.text);
  if (IsSweep(text)) {
    throw Failure(ExitCode::kUsage, fmt::format("{0} is a sweep; contactctl init {0} writes it",
                                                arguments.from_template));
  }
  return Checked(ScenarioFile(arguments.from_template, text, ParseVariables(arguments.variables)),
                 arguments.overrides, kNoLimits);
}

ScenarioFile Open(Client& client, const RunArguments& arguments) {
  const int sources = static_cast<int>(!arguments.file.empty()) +
                      static_cast<int>(!arguments.like.empty()) +
                      static_cast<int>(!arguments.from_template.empty());
  if (sources != 1) {
    throw Failure(ExitCode::kUsage, "give a FILE, --template NAME or --like JOB, one of them");
  }
  if (!arguments.from_template.empty()) return OpenTemplate(arguments);
  if (!arguments.like.empty()) return OpenLike(client, arguments);
  return Checked(ScenarioFile::Open(arguments.file, ParseVariables(arguments.variables)),
                 arguments.overrides, kNoLimits);
}

// What the server finds wrong is shown at its place in the file, as what is found here.
v1::Job Create(Client& client, const RunArguments& arguments) {
  ScenarioFile file = Open(client, arguments);
  TellAdvice(file);
  try {
    return client.Call(&Client::Stub::CreateJob, Request(arguments, file.scenario()));
  } catch (const CallFailure& failure) {
    if (failure.code() != ExitCode::kInvalidScenario) throw failure.AllTold();
    for (const Violation& violation : failure.violations()) file.Add(violation);
    RequireNone(file.diagnostics());
    throw;
  }
}

ExitCode Submit(const RunArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  const v1::Job job = Create(client, arguments);
  PrintJob(job, settings);
  if (settings.output == OutputFormat::kTable) {
    fmt::print(stderr, "Next:  contactctl watch {}\n", ShortName(job.name()));
  }
  return ExitCode::kOk;
}

IterationRows RowsOf(const std::string& word) {
  if (word == "all") return IterationRows::kAll;
  return word == "none" ? IterationRows::kNone : IterationRows::kFirst;
}

ExitCode Run(const RunArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  arguments.columns.Check(LedgerColumns(), settings);
  const auto deadline = settings.Deadline();
  Client client = Connect(settings);
  const v1::Job job = Create(client, arguments);
  const WatchEnd end = FollowRun(client, job.name(), deadline, RowsOf(arguments.rows), settings);
  if (end != WatchEnd::kFinished) {
    return DetachOrCancel(client, end, job.name(), arguments.cancel_on_interrupt, settings);
  }

  const v1::Job result = GetJob(client, job.name());
  PrintJob(result, settings, arguments.columns.names());
  if (settings.output == OutputFormat::kTable) fmt::print(stderr, "{}", NextSteps(result));
  return CodeOf(result);
}

// Which scenario `run` and `submit` take, and what of it they change.
void AddScenario(CommandLine& line, CLI::App& command, RunArguments* arguments) {
  line.SetKind(command.add_option("FILE", arguments->file,
                                  "Scenario in YAML or JSON; - is the standard input"),
               ValueKind::kScenarioFile);
  line.SetKind(command.add_option("--like", arguments->like,
                                  "Repeat this job instead of a file; on the same server bit for "
                                  "bit"),
               ValueKind::kJob);
  line.SetKind(command.add_option("-t,--template", arguments->from_template,
                                  "Take a scenario that init would write, instead of a file"),
               ValueKind::kTemplate);
  line.SetKind(command.add_option("--set", arguments->overrides,
                                  "Override a field, such as contacts[0].restitution=0.7; "
                                  "repeatable"),
               ValueKind::kAssignment)
      ->take_all()
      ->allow_extra_args(false);
  AddVariableFlag(command, &arguments->variables);
}

std::shared_ptr<RunArguments> AddArguments(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<RunArguments>();
  AddScenario(line, command, arguments.get());
  command
      .add_option("--label", arguments->labels, "Label of the job, to find it again; repeatable")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--request-id", arguments->request_id,
                  "The same id and scenario make one job, however often submitted")
      ->type_name("ID");
  arguments->job.AddTo(command);
  return arguments;
}

// How `run` follows what it submitted.
void AddFollowing(CommandLine& line, CLI::App& run, RunArguments* arguments) {
  line.SetWords(run.add_option("--iterations", arguments->rows,
                               "Rows of the μ-iteration to show: the first 60, all or none"),
                {"first", "all", "none"})
      ->type_name("ROWS")
      ->capture_default_str();
  run.add_flag("--cancel-on-interrupt", arguments->cancel_on_interrupt,
               "A first Ctrl-C cancels the job instead of leaving it to the server");
  arguments->columns.AddTo(line, run, LedgerColumns());
}

}  // namespace

void AddRun(CommandLine& line, CLI::App& command) {
  const auto arguments = AddArguments(line, command);
  AddFollowing(line, command, arguments.get());
  line.SetAction(command, arguments, Run);
}

void AddSubmit(CommandLine& line, CLI::App& command) {
  line.SetAction(command, AddArguments(line, command), Submit);
}

}  // namespace contact::cli
