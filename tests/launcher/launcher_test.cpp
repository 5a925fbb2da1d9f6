#include "launcher/launcher.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <sstream>
#include <string>

namespace contact::launcher {
namespace {

using namespace std::chrono_literals;

class HandClock final : public Clock {
 public:
  std::chrono::system_clock::time_point Now() const override { return {}; }
  std::chrono::steady_clock::time_point Elapsed() const override { return now; }
  std::chrono::steady_clock::time_point now{1h};
};

class FakeFleet final : public WorkerFleet {
 public:
  absl::Status Start(int count) override {
    ++starts;
    if (refusal.ok()) alive += count;
    if (dies_at_once) alive -= count;
    return refusal;
  }
  absl::StatusOr<int> Count() override {
    if (!blindness.ok()) return blindness;
    return alive;
  }

  int alive = 0;
  int starts = 0;
  bool dies_at_once = false;
  absl::Status refusal;
  absl::Status blindness;
};

// A launcher for 4 workers of 2 threads that looks every 2 s.
class LauncherTest : public testing::Test {
 protected:
  LauncherTest() {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(
        "", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_)));
  }
  ~LauncherTest() override { spdlog::set_default_logger(std::make_shared<spdlog::logger>("")); }

  void LookFor(std::chrono::seconds time) {
    for (auto left = time; left > 0s; left -= 2s) {
      launcher_.Look();
      clock_.now += 2s;
    }
  }
  // Lines of the log with the text.
  int Logged(const std::string& text) const {
    const std::string log = log_.str();
    int lines = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++lines;
    return lines;
  }

  std::ostringstream log_;
  HandClock clock_;
  FakeFleet fleet_;
  absl::StatusOr<Demand> demand_ = Demand{};
  Launcher launcher_{[this] { return demand_; },
                     fleet_,
                     {.min_workers = 0, .max_workers = 4, .threads = 2},
                     2s,
                     clock_};
};

TEST_F(LauncherTest, StartsWhatIsMissingAtTheFirstLook) {
  demand_ = Demand{.queued = 3};
  launcher_.Look();
  EXPECT_EQ(fleet_.alive, 2);
}

TEST_F(LauncherTest, WorkersThatAreNotAtWorkYetAreNotStartedAgain) {
  demand_ = Demand{.queued = 3};
  LookFor(1h);
  EXPECT_EQ(fleet_.starts, 1);
}

TEST_F(LauncherTest, EndsNobodyWhenLessIsToDo) {
  demand_ = Demand{.queued = 8};
  launcher_.Look();
  demand_ = Demand{};
  LookFor(1h);
  EXPECT_EQ(fleet_.alive, 4);
}

TEST_F(LauncherTest, WorkersThatLeftAreReplacedWhileThereIsWork) {
  demand_ = Demand{.queued = 8};
  LookFor(1min);
  fleet_.alive = 1;
  launcher_.Look();
  EXPECT_EQ(fleet_.alive, 4);
  EXPECT_EQ(Logged("soon"), 0);
}

TEST_F(LauncherTest, NothingIsStartedUnlessDemandAndWorkersAreKnown) {
  demand_ = absl::UnavailableError("no database");
  LookFor(1min);
  demand_ = Demand{.queued = 8};
  fleet_.blindness = absl::UnavailableError("no squeue");
  LookFor(1min);
  EXPECT_EQ(fleet_.starts, 0);
  EXPECT_EQ(Logged("no database"), 1);
  EXPECT_EQ(Logged("no squeue"), 1);
  fleet_.blindness = absl::OkStatus();
  launcher_.Look();
  EXPECT_EQ(fleet_.alive, 4);
  EXPECT_EQ(Logged("well again"), 1);
}

TEST_F(LauncherTest, StartsThatFailAreTriedLessAndLessOften) {
  demand_ = Demand{.queued = 8};
  fleet_.refusal = absl::UnavailableError("no such partition");
  LookFor(1min);  // At 0, 2, 6, 14, 30 s.
  EXPECT_EQ(fleet_.starts, 5);
  LookFor(1h);
  const int starts = fleet_.starts;
  LookFor(1h);
  EXPECT_EQ(fleet_.starts - starts, 1h / Launcher::kLongestDelay);
  EXPECT_EQ(Logged("no such partition"), 1);
}

TEST_F(LauncherTest, WorkersThatEndAtOnceAreStartedLessAndLessOften) {
  demand_ = Demand{.queued = 1};
  fleet_.dies_at_once = true;
  LookFor(1h);
  EXPECT_LT(fleet_.starts, 20);
  EXPECT_EQ(Logged("soon after their start"), 1);
}

TEST_F(LauncherTest, WorkersThatStayEndTheWaiting) {
  demand_ = Demand{.queued = 8};
  fleet_.refusal = absl::UnavailableError("no such partition");
  LookFor(1h);
  fleet_.refusal = absl::OkStatus();
  LookFor(Launcher::kLongestDelay + Launcher::kSettled + 2s);
  EXPECT_EQ(fleet_.alive, 4);
  EXPECT_EQ(Logged("well again"), 1);
  fleet_.alive = 0;
  launcher_.Look();
  EXPECT_EQ(fleet_.alive, 4);
}

}  // namespace
}  // namespace contact::launcher
