#include "cli/verbs/job/follow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/link/jobs.h"
#include "cli/text/convergence.h"
#include "cli/text/print_job.h"
#include "cli/text/render_live.h"

namespace contact::cli {
namespace {

ExitCode Cancel(Client& client, const std::string& name) {
  CancelJob(client, name);
  Tell("contactctl: {} is asked to stop\n", ShortName(name));
  return ExitCode::kInterrupted;
}

}  // namespace

WatchEnd FollowRun(Client& client, const std::string& name, Deadline deadline, IterationRows rows,
                   const Settings& settings) {
  constexpr int kMostIterations = 60;
  const Interrupt interrupt;  // Installed before the name of the job is told.
  WatchOptions options{
      .name = name, .kinds = {"progress"}, .deadline = deadline, .stopped = Interrupt::raised};
  if (settings.output == OutputFormat::kTable) {
    Tell("{} submitted\n", name);
    options.kinds = {"progress", "log_entry", "attempt_started"};
    if (rows != IterationRows::kNone) {
      options.kinds.insert(options.kinds.end(), {"iteration", "group_growth"});
    }
  }
  const Style style = settings.MessageStyle();
  LiveView view({.rows = stderr,
                 .rows_style = style,
                 .messages = stderr,
                 .messages_style = style,
                 .cycles = false,
                 .most_iterations = rows == IterationRows::kAll ? 0 : kMostIterations,
                 .job = ShortName(name),
                 .progress = settings.Progress()});
  const WatchEnd end = Watch(client, options, view);
  if (end == WatchEnd::kFinished) view.OnSnapshot(GetJob(client, name));  // The last progress.
  return end;
}

ExitCode PrintResult(Client& client, const std::string& name, const Settings& settings,
                     const std::vector<std::string>& columns) {
  const v1::Job job = GetJob(client, name);
  PrintJob(job, settings, columns);
  if (settings.output == OutputFormat::kTable) Tell("{}", NextSteps(job));
  return CodeOf(job);
}

WatchEnd WatchJob(Client& client, const std::string& name, const std::vector<std::string>& kinds,
                  const Settings& settings, WatchObserver& observer) {
  const WatchOptions options{
      .name = name, .kinds = kinds, .deadline = settings.Deadline(), .stopped = Interrupt::raised};
  return Watch(client, options, observer);
}

WatchEnd AwaitEnd(Client& client, const std::string& name, const Settings& settings) {
  const Interrupt interrupt;
  WatchObserver silence;
  return WatchJob(client, name, {"state_changed"}, settings, silence);
}

v1::Job CancelJob(Client& client, const std::string& name) {
  v1::CancelJobRequest request;
  request.set_name(name);
  return client.Call(&Client::Stub::CancelJob, request);
}

void DeleteJob(Client& client, const std::string& name) {
  v1::DeleteJobRequest request;
  request.set_name(name);
  client.Call(&Client::Stub::DeleteJob, request);
}

ExitCode Detach(WatchEnd end, const std::string& name) {
  const bool interrupted = end == WatchEnd::kStopped;
  Tell("contactctl: {}; the job continues: contactctl watch {}\n",
       interrupted ? "interrupted" : "time is up", ShortName(name));
  return interrupted ? ExitCode::kInterrupted : ExitCode::kTimeout;
}

ExitCode DetachOrCancel(Client& client, WatchEnd end, const std::string& name, bool cancel,
                        const Settings& settings) {
  using namespace std::chrono_literals;
  if (end == WatchEnd::kStopped && cancel) return Cancel(client, name);
  if (end != WatchEnd::kStopped || !settings.MessageStyle().terminal) return Detach(end, name);
  const Interrupt again;
  Tell("contactctl: interrupted; Ctrl-C again within 2 s cancels the job\n");
  for (auto waited = 0ms; waited < 2s; waited += 50ms) {
    if (Interrupt::raised()) return Cancel(client, name);
    std::this_thread::sleep_for(50ms);
  }
  return Detach(end, name);
}

std::string NextSteps(const v1::Job& job) {
  const std::string id = ShortName(job.name());
  const std::string hints = ConvergenceHints(job);
  std::vector<std::pair<std::string, std::string_view>> steps = {
      {"watch " + id, "the iteration and all events again"},
      {fmt::format("describe {} -o json", id), "every number"}};
  if (job.cycles_size() > 0 && !job.scenario().output().ledger_only()) {
    steps.emplace_back(fmt::format("plot {} hysteresis", id), "force over deformation");
  }
  if (!hints.empty()) {
    steps.emplace_back(fmt::format("describe {} --only-missed", id), "the cycles that miss");
    steps.emplace_back("explain", "what the words of the ledger mean");
  }
  std::size_t width = 0;
  for (const auto& [words, about] : steps) width = std::max(width, words.size());
  std::string text;
  for (const auto& [words, about] : steps) {
    text += fmt::format("{} contactctl {:<{}}  {}\n", text.empty() ? "Next: " : "      ", words,
                        width, about);
  }
  return text + hints;
}

}  // namespace contact::cli
