// Runs wait while the process takes more memory than they may have.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "jobs_fixture.h"

namespace contact {
namespace {

class MemoryGuardTest : public JobsTest {
 protected:
  static constexpr std::int64_t kBudget = std::int64_t{1} << 30;

  MemoryGuardTest() {
    JobOptions options = WithFakeRun({.workers = 2});
    options.max_budget.memory_bytes = kBudget;
    options.look_interval = std::chrono::milliseconds(1);
    options.resident = [this] {
      ++looks_;
      return resident_.load();
    };
    Open(options);
  }
  ~MemoryGuardTest() override { manager_.reset(); }

  // Until the server has looked at its memory again.
  void AwaitLooks() {
    const int before = looks_;
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (looks_ < before + 3 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  }

  std::atomic<std::int64_t> resident_ = 0;
  std::atomic<int> looks_ = 0;
};

TEST_F(MemoryGuardTest, NoRunBeginsBesideAnotherUntilThereIsMemory) {
  resident_ = 2 * kBudget + 1;
  Create();
  run_.AwaitStarted(1);
  AwaitLooks();
  const std::string other = Create();
  AwaitLooks();
  EXPECT_EQ(run_.started(), 1);
  EXPECT_EQ(Get(other).value().state(), v1::Job::QUEUED);
  resident_ = kBudget;
  run_.AwaitStarted(2);
}

TEST_F(MemoryGuardTest, OneRunAfterTheOtherBeginsWhateverIsTaken) {
  resident_ = 2 * kBudget + 1;
  const std::string first = Create();
  run_.AwaitStarted(1);
  AwaitLooks();
  Create();
  run_.Allow();
  run_.AwaitStarted(2);
  EXPECT_EQ(Ended(first).state(), v1::Job::SUCCEEDED);
}

}  // namespace
}  // namespace contact
