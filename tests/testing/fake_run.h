#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "simulation/run.h"
#include "testing/await.h"

namespace contact {

inline Outcome Ending(Outcome::End end, std::string message = "") {
  Outcome outcome;
  outcome.end = end;
  outcome.message = std::move(message);
  return outcome;
}

/// Takes the place of the solver: every run waits until it is let go or stopped. Thread-safe.
class FakeRun {
 public:
  /// What a run does once it is let go.
  using Script = std::function<Outcome(const Scenario&, Observer&, const std::stop_token&)>;

  explicit FakeRun(Script script = [](const auto&...) { return Outcome{}; })
      : script_(std::move(script)) {}

  Outcome operator()(const Scenario& scenario, Observer& observer, const std::stop_token& stop) {
    {
      std::unique_lock lock(mutex_);
      ++started_;
      changed_.notify_all();
      changed_.wait(lock, stop, [&] { return allowed_ > 0; });
      if (stop.stop_requested()) return Ending(Outcome::End::kStopped);
      --allowed_;
    }
    return script_(scenario, observer, stop);
  }

  /// Lets that many runs go.
  void Allow(int runs = 1) {
    const std::lock_guard lock(mutex_);
    allowed_ += runs;
    changed_.notify_all();
  }

  /// Waits until that many runs have started in all.
  void AwaitStarted(int runs) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, kPatience, [&] { return started_ >= runs; })) {
      throw std::runtime_error("the run does not start");
    }
  }
  int started() {
    const std::lock_guard lock(mutex_);
    return started_;
  }

 private:
  const Script script_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  int started_ = 0;
  int allowed_ = 0;
};

}  // namespace contact
