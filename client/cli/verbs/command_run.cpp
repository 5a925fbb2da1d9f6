#include <memory>
#include <utility>
#include <variant>

#include "cli/base/message.h"
#include "cli/input/scenario_file.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/text/render_ledger.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/job/scenario_source.h"
#include "cli/verbs/job/submission.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct RunArguments {
  ScenarioSource scenario;
  Submission submission;
  std::string rows = "first";  // Of the μ-iteration: a value of --iterations.
  bool cancel_on_interrupt = false;
  ColumnChoice columns;
};

// Mistakes that only the server finds are shown at their place in the file, like the others.
v1::Job Create(Client& client, ScenarioFile file, const Submission& submission) {
  TellAdvice(file);
  v1::CreateJobRequest request = submission.Request();
  *request.mutable_job()->mutable_scenario() = file.scenario();
  try {
    return client.Call(&Client::Stub::CreateJob, request);
  } catch (const CallFailure& failure) {
    if (failure.code() != ExitCode::kInvalidScenario) throw failure.AllTold();
    for (const Violation& violation : failure.violations()) file.Add(violation);
    RequireNone(file.diagnostics());
    throw;
  }
}

v1::Job Create(Client& client, const v1::Sweep& sweep, const Submission& submission) {
  v1::CreateJobRequest request = submission.Request();
  *request.mutable_job()->mutable_sweep() = sweep;
  return client.CallTellingAll(&Client::Stub::CreateJob, request);
}

ExitCode Submit(const RunArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  const auto create = [&](auto spec) {
    return Create(client, std::move(spec), arguments.submission);
  };
  const v1::Job job = std::visit(create, arguments.scenario.Open(client));
  PrintJob(job, settings);
  if (settings.output == OutputFormat::kTable) {
    Tell("Next:  contactctl {}watch {}\n", job.has_sweep() ? "sweep " : "", ShortName(job.name()));
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
  const std::string name =
      Create(client, arguments.scenario.OpenScenario(client), arguments.submission).name();
  const WatchEnd end = FollowRun(client, name, deadline, RowsOf(arguments.rows), settings);
  if (end != WatchEnd::kFinished) {
    return DetachOrCancel(client, end, name, arguments.cancel_on_interrupt, settings);
  }
  return PrintResult(client, name, settings, arguments.columns.names());
}

std::shared_ptr<RunArguments> AddArguments(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<RunArguments>();
  arguments->scenario.AddTo(line, command);
  arguments->submission.AddTo(command, "scenario");
  return arguments;
}

}  // namespace

void AddRun(CommandLine& line, CLI::App& command) {
  const auto arguments = AddArguments(line, command);
  AddOption(line, command, "--iterations", &arguments->rows, {"first", "all", "none"},
            "Rows of the μ-iteration to show: the first 60, all or none")
      ->type_name("ROWS")
      ->capture_default_str();
  command.add_flag("--cancel-on-interrupt", arguments->cancel_on_interrupt,
                   "A first Ctrl-C cancels the job instead of leaving it to the server");
  arguments->columns.AddTo(line, command, LedgerColumns(), false);
  line.SetAction(command, arguments, Run);
}

void AddSubmit(CommandLine& line, CLI::App& command) {
  line.SetAction(command, AddArguments(line, command), Submit);
}

}  // namespace contact::cli
