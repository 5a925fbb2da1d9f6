#include "cli/verbs/list_watch.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/base/interrupt.h"
#include "cli/base/number.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/link/watch_jobs.h"
#include "cli/text/convergence.h"
#include "cli/text/render_job.h"
#include "cli/text/render_json.h"
#include "cli/verbs/job/follow.h"

namespace contact::cli {
namespace {

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

}  // namespace

ExitCode ListAndWatch(const v1::WatchJobsRequest& request, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJsonLines});
  Client client = Connect(settings);
  const Interrupt interrupt;
  JobLines lines(settings);
  const JobsWatchOptions options{
      .request = request, .deadline = settings.Deadline(), .stopped = Interrupt::raised};
  const WatchEnd end = WatchJobs(client, options, lines);
  return end == WatchEnd::kStopped ? ExitCode::kInterrupted : ExitCode::kTimeout;
}

}  // namespace contact::cli
