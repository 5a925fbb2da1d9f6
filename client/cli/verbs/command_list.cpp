#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cstdio>
#include <memory>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/help/candidates.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/link/watch_jobs.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/options.h"
#include "cli/text/convergence.h"
#include "cli/text/print_job.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct ListArguments {
  std::vector<std::string> states;
  std::vector<std::string> labels;
  int limit = 50;
  bool all = false;
  bool watch = false;
  ColumnChoice columns;
};

constexpr int kMostTitle = 40;  // A longer one would take the place of other columns.

v1::Job::State ParseState(std::string text) {
  boost::to_upper(text);
  v1::Job::State state = v1::Job::STATE_UNSPECIFIED;
  if (v1::Job::State_Parse(text, &state) && state != v1::Job::STATE_UNSPECIFIED) return state;
  const std::vector<std::string_view> states = JobStates();
  throw Failure(ExitCode::kUsage, WithHint(fmt::format("--state {}: one of {}", Quoted(text),
                                                       fmt::join(states, ", ")),
                                           DidYouMean(text, states)));
}

// A request with the filter of the arguments.
template <class Request>
Request Filtered(const ListArguments& arguments) {
  Request request;
  for (const std::string& state : arguments.states) request.add_states(ParseState(state));
  const auto labels = ParseLabels(arguments.labels);
  request.mutable_labels()->insert(labels.begin(), labels.end());
  return request;
}

// The jobs of all pages, up to the limit; with a page token if there are more.
v1::ListJobsResponse ListAll(Client& client, const ListArguments& arguments) {
  constexpr int kPage = 500;
  auto request = Filtered<v1::ListJobsRequest>(arguments);
  v1::ListJobsResponse all;
  do {
    const int missing = arguments.limit - all.jobs_size();
    request.set_page_size(arguments.all ? kPage : std::min(kPage, missing));
    const v1::ListJobsResponse page = client.Call(&Client::Stub::ListJobs, request);
    all.MergeFrom(page);
    all.set_next_page_token(page.next_page_token());
    request.set_page_token(page.next_page_token());
  } while (!all.next_page_token().empty() && (arguments.all || all.jobs_size() < arguments.limit));
  return all;
}

std::string Convergence(const v1::Job& job) {
  return job.convergence() == v1::Job::CONVERGENCE_UNSPECIFIED
             ? "-"
             : v1::Job::Convergence_Name(job.convergence());
}

// Lists leave the spec out, but of a sweep they have the number of its cells.
std::string KindOf(const v1::Job& job) { return job.progress().cells() > 0 ? "sweep" : "scenario"; }

std::vector<Table::Column> ListColumns() {
  return {{"JOB"},
          {"STATE"},
          {"TITLE", false, 1},
          {"KIND", false, 8},
          {"REASON", false, 5},
          {"CONVERGENCE", false, 3},
          {"MISSED", true, 4},
          {"CREATED (UTC)", false, 2},
          {"ENDED (UTC)", false, 6},
          {"LABELS", false, 7},
          {"CYCLES", true, Table::kOnlyWide},
          {"ATTEMPT", true, Table::kOnlyWide}};
}

std::vector<Table::Cell> ListRow(const v1::Job& job) {
  return {ShortName(job.name()),
          {v1::Job::State_Name(job.state()), ToneOf(job.state())},
          TitleOf(job),
          KindOf(job),
          job.state_reason().empty() ? "-" : job.state_reason(),
          Convergence(job),
          MissedCount(job),
          Instant(job.create_time()),
          Instant(job.end_time()),
          LabelsText(job),
          fmt::to_string(job.progress().cycles()),
          fmt::to_string(job.attempt())};
}

// `most_title`: characters of a title that are shown; 0: all.
Table ListTable(const v1::ListJobsResponse& all, int most_title = 0) {
  Table table(ListColumns());
  for (v1::Job job : all.jobs()) {
    job.set_title(OneLine(TitleOf(job), most_title));
    table.Add(ListRow(job));
  }
  return table;
}

void PrintList(const v1::ListJobsResponse& all, const ColumnChoice& columns,
               const Settings& settings) {
  switch (settings.output) {
    case OutputFormat::kJson:
      return PrintJson(ToJson(all), settings);
    case OutputFormat::kCsv:
      return fmt::print("{}", ListTable(all).Csv(columns.names()));
    case OutputFormat::kTable:
      fmt::print("{}", ListTable(all, kMostTitle).Text(columns.OutputStyle(settings)));
      if (!all.next_page_token().empty()) Tell("… and more; --all lists them\n");
      return;
    default:
      for (const v1::Job& job : all.jobs()) {
        const bool name = settings.output == OutputFormat::kName;
        fmt::print("{}", name ? job.name() + "\n" : ToJsonLine(job));
      }
  }
}

// Prints a line for each job that is new, has changed or was deleted.
class JobLines : public JobsObserver {
 public:
  explicit JobLines(const Settings& settings) : settings_(settings) {}

  void OnJob(const v1::Job& job) override {
    if (settings_.output == OutputFormat::kJsonLines) return Print(ToJsonLine(job));
    const auto& time = job.has_end_time()     ? job.end_time()
                       : job.has_start_time() ? job.start_time()
                                              : job.create_time();
    std::string line =
        fmt::format("{}  {}  {}", Instant(time), ShortName(job.name()),
                    StateText(job.state(), job.state_reason(), settings_.OutputStyle()));
    if (job.convergence() == v1::Job::PARTIAL) line += ", convergence " + ConvergenceText(job);
    if (!TitleOf(job).empty()) line += "  " + OneLine(TitleOf(job));
    Print(line + "\n");
  }

  void OnGone(const std::string& name) override {
    v1::WatchJobsResponse gone;
    gone.add_gone(name);
    Print(settings_.output == OutputFormat::kJsonLines ? ToJsonLine(gone)
                                                       : ShortName(name) + "  gone\n");
  }

  void OnLost(const std::string& why) override { TellLost(why); }
  void OnRegained() override { TellRegained(); }

 private:
  static void Print(const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  const Settings& settings_;
};

// Prints a line for each job, then one for each change, until Ctrl-C or --timeout.
ExitCode ListAndWatch(const ListArguments& arguments, const Settings& settings) {
  const auto request = Filtered<v1::WatchJobsRequest>(arguments);
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJsonLines});
  Client client = Connect(settings);
  const Interrupt interrupt;
  JobLines lines(settings);
  const JobsWatchOptions options{
      .request = request, .deadline = settings.Deadline(), .stopped = Interrupt::raised};
  const WatchEnd end = WatchJobs(client, options, lines);
  return end == WatchEnd::kStopped ? ExitCode::kInterrupted : ExitCode::kTimeout;
}

ExitCode List(const ListArguments& arguments, const Settings& settings) {
  if (arguments.watch) return ListAndWatch(arguments, settings);
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kJsonLines,
                          OutputFormat::kCsv, OutputFormat::kName});
  arguments.columns.Check(ListColumns(), settings);
  Client client = Connect(settings);
  PrintList(ListAll(client, arguments), arguments.columns, settings);
  return ExitCode::kOk;
}

}  // namespace

void AddList(CommandLine& line, CLI::App& list) {
  auto arguments = std::make_shared<ListArguments>();
  Repeatable(AddOption(line, list, "--state", &arguments->states, ValueKind::kState,
                       "Only jobs in this state; repeatable"));
  Repeatable(list.add_option("--label", arguments->labels, "Only jobs with this label; repeatable"))
      ->type_name("KEY=VALUE");
  CLI::Option* limit =
      AddCount(list, "--limit", &arguments->limit, "Most jobs to list")->capture_default_str();
  list.add_flag("--all", arguments->all, "List all jobs")->excludes(limit);
  list.add_flag("--watch", arguments->watch,
                "All of them, and then a line for each change; -o jsonl for programs");
  arguments->columns.AddTo(line, list, ListColumns());
  line.SetAction(list, arguments, List);
}

}  // namespace contact::cli
