#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>  // All of it: a program without main.cpp may link this file.
#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/link/connect.h"
#include "cli/link/job_names.h"
#include "cli/link/job_source.h"
#include "cli/settings/column_choice.h"
#include "cli/text/print_job.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/text/render_ledger.h"
#include "cli/verbs/commands.h"
#include "cli/verbs/list_watch.h"

namespace contact::cli {
namespace {

struct ListArguments {
  std::vector<std::string> states;
  std::vector<std::string> labels;
  int limit = 50;
  bool watch = false;
  ColumnChoice columns;
};

v1::Job::State ParseState(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  v1::Job::State state = v1::Job::STATE_UNSPECIFIED;
  if (v1::Job::State_Parse(text, &state) && state != v1::Job::STATE_UNSPECIFIED) return state;
  const std::string_view nearest =
      Nearest(text, {"QUEUED", "RUNNING", "SUCCEEDED", "FAILED", "CANCELLED"});
  throw Failure(ExitCode::kUsage,
                fmt::format("--state {}: one of QUEUED, RUNNING, SUCCEEDED, FAILED, CANCELLED{}",
                            Quoted(text),
                            nearest.empty() ? "" : fmt::format(" — did you mean {}?", nearest)));
}

// All pages, up to the limit.
v1::ListJobsResponse ListAll(Client& client, const ListArguments& arguments) {
  constexpr int kPage = 500;
  v1::ListJobsRequest request;
  for (const std::string& state : arguments.states) request.add_states(ParseState(state));
  for (const auto& [key, value] : ParseLabels(arguments.labels)) {
    (*request.mutable_labels())[key] = value;
  }
  v1::ListJobsResponse all;
  do {
    const int missing = arguments.limit - all.jobs_size();
    request.set_page_size(arguments.limit > 0 ? std::min(kPage, missing) : kPage);
    const v1::ListJobsResponse page = client.Call(&Client::Stub::ListJobs, request);
    all.MergeFrom(page);
    all.set_next_page_token(page.next_page_token());
    request.set_page_token(page.next_page_token());
  } while (!all.next_page_token().empty() &&
           (arguments.limit <= 0 || all.jobs_size() < arguments.limit));
  return all;
}

std::string Labels(const v1::Job& job) {
  std::vector<std::string> labels;
  for (const auto& [key, value] : job.labels()) labels.push_back(fmt::format("{}={}", key, value));
  std::ranges::sort(labels);
  return fmt::format("{}", fmt::join(labels, ", "));
}

std::string Convergence(const v1::Job& job) {
  return job.convergence() == v1::Job::CONVERGENCE_UNSPECIFIED
             ? "-"
             : v1::Job::Convergence_Name(job.convergence());
}

v1::WatchJobsRequest WatchRequest(const ListArguments& arguments) {
  v1::WatchJobsRequest request;
  for (const std::string& state : arguments.states) request.add_states(ParseState(state));
  for (const auto& [key, value] : ParseLabels(arguments.labels)) {
    (*request.mutable_labels())[key] = value;
  }
  return request;
}

std::vector<Table::Column> ListColumns() {
  return {{"JOB"},
          {"STATE"},
          {"REASON", false, 2},
          {"CONVERGENCE", false, 3},
          {"CREATED (UTC)", false, 1},
          {"ENDED (UTC)", false, 4},
          {"LABELS", false, 5},
          {"CYCLES", true, Table::kOnlyWide},
          {"ATTEMPT", true, Table::kOnlyWide}};
}

std::vector<Table::Cell> ListRow(const v1::Job& job) {
  return {ShortName(job.name()),
          {v1::Job::State_Name(job.state()), ToneOf(job.state())},
          job.state_reason().empty() ? "-" : job.state_reason(),
          Convergence(job),
          Instant(job.create_time()),
          Instant(job.end_time()),
          Labels(job),
          fmt::to_string(job.progress().cycles()),
          fmt::to_string(job.attempt())};
}

Table ListTable(const v1::ListJobsResponse& all) {
  Table table(ListColumns());
  for (const v1::Job& job : all.jobs()) table.Add(ListRow(job));
  return table;
}

ExitCode List(const ListArguments& arguments, const Settings& settings) {
  if (arguments.watch) return ListAndWatch(WatchRequest(arguments), settings);
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kJsonLines,
                          OutputFormat::kCsv, OutputFormat::kName});
  arguments.columns.Check(ListColumns(), settings);
  Client client = Connect(settings);
  const v1::ListJobsResponse all = ListAll(client, arguments);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(ToJson(all), settings);
  } else if (settings.output == OutputFormat::kCsv) {
    fmt::print("{}", ListTable(all).Csv(arguments.columns.names()));
  } else if (settings.output == OutputFormat::kTable) {
    fmt::print("{}", ListTable(all).Text(arguments.columns.OutputStyle(settings)));
  } else {
    const bool names = settings.output == OutputFormat::kName;
    for (const v1::Job& job : all.jobs()) {
      fmt::print("{}", names ? job.name() + "\n" : ToJsonLine(job));
    }
  }
  if (settings.output == OutputFormat::kTable && !all.next_page_token().empty()) {
    fmt::print(stderr, "… and more; --limit 0 lists all\n");
  }
  return ExitCode::kOk;
}

ExitCode Describe(const std::string& job, const ColumnChoice& columns, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  columns.Check(LedgerColumns(), settings);
  Client client = Connect(settings);
  PrintJob(GetJob(client, job), settings, columns.names());
  return ExitCode::kOk;
}

ExitCode Cancel(const std::string& job, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kName});
  v1::CancelJobRequest request;
  request.set_name(JobName(job));
  const v1::Job answer = Connect(settings).Call(&Client::Stub::CancelJob, request);
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
  v1::DeleteJobRequest request;
  request.set_name(JobName(job));
  Connect(settings).Call(&Client::Stub::DeleteJob, request);
  fmt::print("{}{}\n", request.name(), settings.output == OutputFormat::kTable ? "  deleted" : "");
  return ExitCode::kOk;
}

// A command whose one argument is a job.
CLI::App* AddJobCommand(CLI::App& app, const std::string& name, const std::string& description,
                        ExitCode (*act)(const std::string&, const Settings&),
                        const Settings& settings, Action* action) {
  auto job = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("JOB", *job, "ID or jobs/ID")->required();
  command->callback([job, act, &settings, action] {
    *action = [job, act, &settings] { return act(*job, settings); };
  });
  return command;
}

void AddDescribeCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto job = std::make_shared<std::string>();
  auto columns = std::make_shared<ColumnChoice>();
  CLI::App* describe =
      app.add_subcommand("describe", "Show a job with its ledger (also: result)")->alias("result");
  describe->add_option("JOB", *job, "ID or jobs/ID")->required();
  columns->AddTo(*describe, LedgerColumns());
  describe->callback([job, columns, &settings, action] {
    *action = [job, columns, &settings] { return Describe(*job, *columns, settings); };
  });
}

}  // namespace

void AddJobCommands(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<ListArguments>();
  CLI::App* list = app.add_subcommand("list", "List jobs, newest first");
  list->add_option("--state", arguments->states, "Only jobs in this state; repeatable")
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("STATE");
  list->add_option("--label", arguments->labels, "Only jobs with this label; repeatable")
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  list->add_option("--limit", arguments->limit, "At most so many; 0 is all")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N")
      ->capture_default_str();
  list->add_flag("--watch", arguments->watch,
                 "All of them, and then a line for each change; -o jsonl for programs");
  arguments->columns.AddTo(*list, ListColumns());
  list->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return List(*arguments, settings); };
  });

  AddDescribeCommand(app, settings, action);
  AddJobCommand(app, "cancel", "Ask a job to stop; what it recorded is kept", Cancel, settings,
                action);
  AddJobCommand(app, "delete", "Remove an ended job and its events", Delete, settings, action);
}

}  // namespace contact::cli
