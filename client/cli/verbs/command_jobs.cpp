#include <fmt/format.h>

#include <memory>

#include "cli/base/message.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/link/job_source.h"
#include "cli/settings/column_choice.h"
#include "cli/text/convergence.h"
#include "cli/text/print_job.h"
#include "cli/text/render_ledger.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct DescribeArguments {
  std::string job;
  bool only_missed = false;
  ColumnChoice columns;
};

constexpr char kAboutLedger[] =
    R"(Each row of the ledger is a cycle: a compression and the restitution that follows it. ε is the
energy restitution coefficient √(−W_r/W_c), with W_c and W_r the work of the contact force in
compression and in restitution; in an isolated collision it is the ratio of the velocities after
and before. ERROR is |ε OUT − ε IN|/ε IN. A `-` is a number that is not known: the end of the run
cuts the cycle, or ε says nothing of it. contactctl explain says what the words below KIND, END and
STATUS mean.)";

ExitCode Describe(const DescribeArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  arguments.columns.Check(LedgerColumns(), settings);
  if (arguments.only_missed && settings.output != OutputFormat::kTable) {
    throw Failure(ExitCode::kUsage, "--only-missed is of the table; JSON has the whole ledger");
  }
  Client client = Connect(settings);
  v1::Job job = GetJob(client, FindJob(client, arguments.job));
  if (arguments.only_missed) KeepMissed(&job);
  PrintJob(job, settings, arguments.columns.names());
  if (arguments.only_missed && job.cycles().empty()) Tell("no cycle misses its restitution\n");
  return ExitCode::kOk;
}

ExitCode Cancel(const std::string& job, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  const v1::Job answer = CancelJob(client, FindJob(client, job));
  if (settings.output != OutputFormat::kTable) {
    PrintJob(answer, settings);
  } else if (answer.state() == v1::Job::RUNNING) {
    fmt::print("{}  asked to stop\n", answer.name());
  } else {
    fmt::print("{}  {}\n", answer.name(), v1::Job::State_Name(answer.state()));
  }
  return ExitCode::kOk;
}

ExitCode Delete(const std::string& job, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  Client client = Connect(settings);
  v1::DeleteJobRequest request;
  request.set_name(FindJob(client, job));
  client.Call(&Client::Stub::DeleteJob, request);
  fmt::print("{}{}\n", request.name(), settings.output == OutputFormat::kTable ? "  deleted" : "");
  return ExitCode::kOk;
}

// Makes `act` the action of a command whose only argument is a job.
void AddJobAction(CommandLine& line, CLI::App& command,
                  ExitCode (*act)(const std::string&, const Settings&)) {
  auto job = std::make_shared<std::string>();
  AddJob(line, command, job.get());
  line.SetAction(command, job, act);
}

}  // namespace

void AddDescribe(CommandLine& line, CLI::App& describe) {
  auto arguments = std::make_shared<DescribeArguments>();
  describe.alias("result");
  describe.footer(kAboutLedger);
  AddJob(line, describe, &arguments->job);
  describe.add_flag("--only-missed", arguments->only_missed,
                    "Only the cycles and groups that are NOT_CONVERGED or INFEASIBLE");
  arguments->columns.AddTo(line, describe, LedgerColumns(), false);
  line.SetAction(describe, arguments, Describe);
}

void AddCancel(CommandLine& line, CLI::App& cancel) { AddJobAction(line, cancel, Cancel); }

void AddDelete(CommandLine& line, CLI::App& command) { AddJobAction(line, command, Delete); }

}  // namespace contact::cli
