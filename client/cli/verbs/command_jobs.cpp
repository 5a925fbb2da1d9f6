#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/base/message.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/options.h"
#include "cli/text/convergence.h"
#include "cli/text/print_job.h"
#include "cli/text/render_job.h"
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
  const std::string name = FindJob(client, job);
  const bool ended = IsFinal(GetJob(client, name).state());
  const v1::Job answer = CancelJob(client, name);
  if (ended) Tell("{} has ended, so there is nothing to cancel\n", name);
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
  const std::string name = FindJob(client, job);
  DeleteJob(client, name);
  fmt::print("{}{}\n", name, settings.output == OutputFormat::kTable ? "  deleted" : "");
  return ExitCode::kOk;
}

struct LabelArguments {
  std::vector<std::string> words;
  std::optional<std::string> note;
};

// What the words of a line ask for. No job is named with `=` or a last `-`.
struct LabelChange {
  std::vector<std::string> jobs;
  std::map<std::string, std::string> set;
  std::vector<std::string> removed;

  bool empty() const { return set.empty() && removed.empty(); }
};

LabelChange ReadWords(const std::vector<std::string>& words) {
  LabelChange change;
  std::vector<std::string> set;
  for (const std::string& word : words) {
    if (word.find('=') != std::string::npos) {
      set.push_back(word);
    } else if (word.ends_with('-')) {
      change.removed.push_back(word.substr(0, word.size() - 1));
    } else {
      change.jobs.push_back(word);
    }
  }
  change.set = ParseLabels(set);
  return change;
}

// The request for a job as it is now.
v1::UpdateJobRequest Request(const v1::Job& now, const LabelChange& change,
                             const std::optional<std::string>& note) {
  v1::UpdateJobRequest request;
  v1::Job& job = *request.mutable_job();
  job.set_name(now.name());
  request.set_expected_uid(now.uid());
  if (!change.empty()) {
    request.mutable_update_mask()->add_paths("labels");
    *job.mutable_labels() = now.labels();
    for (const std::string& key : change.removed) job.mutable_labels()->erase(key);
    for (const auto& [key, value] : change.set) (*job.mutable_labels())[key] = value;
  }
  if (note) {
    request.mutable_update_mask()->add_paths("note");
    job.set_note(*note);
  }
  return request;
}

ExitCode Label(const LabelArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  const LabelChange change = ReadWords(arguments.words);
  if (change.jobs.empty()) throw Failure(ExitCode::kUsage, "give a job to label");
  if (change.empty() && !arguments.note) {
    throw Failure(ExitCode::kUsage, "say what to change: KEY=VALUE, KEY- or --note TEXT");
  }
  Client client = Connect(settings);
  std::vector<v1::Job> jobs;  // All of them before the first is changed: one may not be there.
  for (const std::string& job : change.jobs) jobs.push_back(GetJob(client, FindJob(client, job)));
  for (const v1::Job& job : jobs) {
    const v1::Job answer =
        client.Call(&Client::Stub::UpdateJob, Request(job, change, arguments.note));
    const bool table = settings.output == OutputFormat::kTable;
    const std::string labels = LabelsText(answer);
    fmt::print("{}{}\n", answer.name(),
               table ? "  " + (labels.empty() ? "no labels" : labels) : "");
  }
  return ExitCode::kOk;
}

constexpr char kAboutLabel[] =
    R"(KEY=VALUE gives a label or changes it, KEY- takes it away; the other labels stay. The jobs may wait,
run or have ended. list --label KEY=VALUE finds them; describe shows labels and note.)";

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

void AddLabel(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<LabelArguments>();
  command.footer(kAboutLabel);
  AddOption(line, command, "JOB", &arguments->words, ValueKind::kJob,
            "Jobs, then KEY=VALUE and KEY-. " + std::string(kJobAbout))
      ->required();
  command
      .add_option("--note", arguments->note,
                  "What to write about the jobs, in place of what is there; '' for nothing")
      ->type_name("TEXT");
  line.SetAction(command, arguments, Label);
}

void AddDelete(CommandLine& line, CLI::App& command) { AddJobAction(line, command, Delete); }

}  // namespace contact::cli
