#include "cli/link/watch_to_end.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "cli/base/interrupt.h"
#include "cli/base/message.h"

namespace contact::cli {
namespace {

// Passes on what comes, and says on the standard error why nothing does.
class Announcer final : public WatchObserver {
 public:
  Announcer(std::string job, WatchObserver& observer) : job_(std::move(job)), observer_(observer) {}

  void OnSnapshot(const v1::Job& job) override {
    state_ = job.state();
    observer_.OnSnapshot(job);
  }
  void OnEvent(const v1::Event& event) override { observer_.OnEvent(event); }
  void OnLost(const std::string& why) override {
    Tell("connection lost ({}); trying again\n", why);
  }
  void OnRegained() override { Tell("connected again\n"); }
  void OnTick() override {
    constexpr std::chrono::milliseconds kShort{500};  // A wait that needs no words.
    const bool waits = state_ == v1::Job::QUEUED || state_ == v1::Job::RUNNING;
    if (waits && !told_ && std::chrono::steady_clock::now() - start_ > kShort) {
      told_ = true;
      Tell("{} is {}; waiting for its end\n", job_, v1::Job::State_Name(state_));
    }
    observer_.OnTick();
  }

 private:
  const std::string job_;
  WatchObserver& observer_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  v1::Job::State state_ = v1::Job::STATE_UNSPECIFIED;
  bool told_ = false;
};

}  // namespace

void WatchToEnd(Client& client, WatchOptions options, const Settings& settings,
                WatchObserver& observer) {
  options.deadline = settings.Deadline();
  options.stopped = Interrupt::raised;
  Announcer announcer(options.name, observer);
  const WatchEnd end = Watch(client, options, announcer);
  if (end == WatchEnd::kFinished) return;
  const bool interrupted = end == WatchEnd::kStopped;
  throw Failure(interrupted ? ExitCode::kInterrupted : ExitCode::kTimeout,
                fmt::format("{}; {} has not ended, or is long",
                            interrupted ? "interrupted" : "time is up", options.name));
}

void ReplayWhole(const std::string& job, const std::function<bool()>& replay) {
  constexpr int kTries = 2;
  for (int i = 0; i < kTries; ++i) {
    if (replay()) return;
  }
  throw Failure(ExitCode::kRunFailed,
                fmt::format("parts of the trajectory of {} do not come; try again", job));
}

}  // namespace contact::cli
