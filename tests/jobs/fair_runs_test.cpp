// Endless runs of several owners on one worker, with the real solver if nothing else is said.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>

#include "jobs_fixture.h"

namespace contact {
namespace {

const Principal kEve{"eve", "umbra", {Role::kSubmit}, "token"};

class FairRunsTest : public JobsTest {
 protected:
  std::string CreateAs(const Principal& caller) {
    Await<Result<v1::Job>> result;
    manager_->creator().Create(caller, RequestFor(BouncingBall()), result.callback());
    return result.Get().value().name();
  }
  v1::Job GetAs(const Principal& caller, const std::string& name) {
    Await<Result<v1::Job>> result;
    manager_->reader().Get(caller, name, result.callback());
    return result.Get().value();
  }
  void CancelAs(const Principal& caller, const std::string& name) {
    v1::CancelJobRequest request;
    request.set_name(name);
    Await<Result<v1::Job>> result;
    manager_->Cancel(caller, request, result.callback());
    EXPECT_TRUE(result.Get().ok());
  }
  // Waits until the run has come past this time.
  void AwaitPast(const Principal& caller, const std::string& name, double time_s) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (GetAs(caller, name).progress().time_s() <= time_s) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << name;
      std::this_thread::yield();
    }
  }
  void AwaitState(const Principal& caller, const std::string& name, v1::Job::State state) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (GetAs(caller, name).state() != state) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << name;
      std::this_thread::yield();
    }
  }
};

TEST_F(FairRunsTest, RunsOfTwoOwnersTakeTurnsOnOneWorker) {
  Open({.workers = 1});
  const std::string ada = CreateAs(kAda);
  AwaitPast(kAda, ada, 0);
  const std::string eve = CreateAs(kEve);
  for (int turn = 0; turn < 2; ++turn) {
    AwaitPast(kEve, eve, GetAs(kEve, eve).progress().time_s());
    AwaitPast(kAda, ada, GetAs(kAda, ada).progress().time_s());
  }
  EXPECT_EQ(GetAs(kAda, ada).attempt(), 1) << "a run that yields is not begun anew";
  // One of them waits for its turn just now.
  CancelAs(kAda, ada);
  CancelAs(kEve, eve);
  AwaitState(kAda, ada, v1::Job::CANCELLED);
  AwaitState(kEve, eve, v1::Job::CANCELLED);
}

// Waits until the count is above `count`.
void AwaitAbove(const std::atomic<int>& steps, int count) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (steps <= count) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    std::this_thread::yield();
  }
}

TEST_F(FairRunsTest, RunsThatNeverReachABoundaryTakeTurns) {
  std::array<std::atomic<int>, 2> steps{};
  std::atomic<std::size_t> begun = 0;
  JobOptions options{.workers = 1};
  options.run = [&](const Scenario&, Observer& observer, const std::stop_token& stop) {
    std::atomic<int>& mine = steps.at(begun++);
    for (; !stop.stop_requested(); ++mine) observer.OnStep();
    return Ending(Outcome::End::kStopped);
  };
  Open(options);
  CreateAs(kAda);
  AwaitAbove(steps[0], 0);
  CreateAs(kEve);
  for (int turn = 0; turn < 2; ++turn) {
    AwaitAbove(steps[1], steps[1]);
    AwaitAbove(steps[0], steps[0]);
  }
  manager_.reset();
}

TEST_F(FairRunsTest, ServerStopsWhileRunsWaitForTheirTurn) {
  Open({.workers = 1});
  const std::string ada = CreateAs(kAda), eve = CreateAs(kEve);
  AwaitPast(kAda, ada, 0);
  AwaitPast(kEve, eve, 0);
  Open({.workers = 1});
  AwaitPast(kEve, eve, 0);
  EXPECT_EQ(GetAs(kEve, eve).attempt(), 1) << "the attempt goes on";
}

}  // namespace
}  // namespace contact
