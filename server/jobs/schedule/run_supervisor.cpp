#include "jobs/schedule/run_supervisor.h"

#include <pthread.h>

namespace contact {

RunSupervisor::RunSupervisor(const Clock& clock, const JobOptions& options, EndingRuns& endings,
                             Lost lost, std::function<void()> look)
    : clock_(clock),
      options_(options),
      endings_(endings),
      lost_(std::move(lost)),
      look_(std::move(look)),
      thread_([this](const std::stop_token& stop) { Loop(stop); }) {}

void RunSupervisor::Add(const std::string& job, std::shared_ptr<RunControl> run) {
  const MutexLock lock(mutex_);
  if (runs_.empty()) added_.notify_one();
  runs_.emplace(job, Run{std::move(run), Watchdog(clock_.Elapsed())});
}

void RunSupervisor::Remove(const std::string& job) {
  const MutexLock lock(mutex_);
  runs_.erase(job);
}

void RunSupervisor::Stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void RunSupervisor::Loop(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "watchdog");
  while (!stop.stop_requested()) {
    for (const auto& [job, run] : Look(stop)) lost_(job, *run);
    endings_.Retry();
    look_();
  }
}

RunSupervisor::Runs RunSupervisor::Look(const std::stop_token& stop) {
  const MutexLock lock(mutex_);
  if (runs_.empty()) {
    added_.wait(mutex_, stop,
                [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return !runs_.empty(); });
  } else {
    added_.wait_for(mutex_, stop, options_.look_interval, [] { return false; });
  }
  const Watchdog::Patience patience{options_.step_timeout, options_.stop_timeout};
  Runs lost;
  for (auto& [job, run] : runs_) {
    if (!run.watchdog.Look(*run.control, clock_.Elapsed(), patience)) continue;
    if (run.control->GiveUp()) lost.emplace_back(job, run.control);
  }
  for (const auto& [job, run] : lost) runs_.erase(job);
  return lost;
}

}  // namespace contact
