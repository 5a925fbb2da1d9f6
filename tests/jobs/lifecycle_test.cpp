#include "jobs/job/lifecycle.h"

#include <gmock/gmock.h>

#include <set>
#include <utility>

#include "testing/fake_run.h"

namespace contact {
namespace {

using JobState = v1::Job::State;

constexpr std::chrono::system_clock::time_point kNow{std::chrono::milliseconds(1500)};

TEST(Lifecycle, OnlyTheMovesOfTheContractAreLegal) {
  const std::set<std::pair<JobState, JobState>> legal = {
      {v1::Job::STATE_UNSPECIFIED, v1::Job::QUEUED}, {v1::Job::QUEUED, v1::Job::RUNNING},
      {v1::Job::QUEUED, v1::Job::CANCELLED},         {v1::Job::RUNNING, v1::Job::QUEUED},
      {v1::Job::RUNNING, v1::Job::SUCCEEDED},        {v1::Job::RUNNING, v1::Job::FAILED},
      {v1::Job::RUNNING, v1::Job::CANCELLED}};
  for (int from = v1::Job::State_MIN; from <= v1::Job::State_MAX; ++from) {
    for (int to = v1::Job::State_MIN; to <= v1::Job::State_MAX; ++to) {
      const auto pair = std::pair(static_cast<JobState>(from), static_cast<JobState>(to));
      EXPECT_EQ(IsTransition(pair.first, pair.second), legal.contains(pair))
          << from << " to " << to;
    }
  }
}

TEST(Lifecycle, FinalStatesAreThoseThatNothingLeaves) {
  for (int from = v1::Job::QUEUED; from <= v1::Job::State_MAX; ++from) {
    bool leaves = false;
    for (int to = v1::Job::State_MIN; to <= v1::Job::State_MAX; ++to) {
      leaves = leaves || IsTransition(static_cast<JobState>(from), static_cast<JobState>(to));
    }
    EXPECT_EQ(IsFinal(static_cast<JobState>(from)), !leaves) << from;
  }
}

TEST(Lifecycle, OutcomeDecidesStateAndReason) {
  using End = Outcome::End;
  const auto after = [](End end) { return TransitionAfter(Ending(end, "here")); };
  EXPECT_EQ(after(End::kFinished).to, v1::Job::SUCCEEDED);
  EXPECT_EQ(after(End::kFinished).state_reason, "");
  EXPECT_EQ(after(End::kStopped).to, v1::Job::CANCELLED);
  EXPECT_EQ(after(End::kStopped).state_reason, "USER_REQUEST");
  for (const auto& [end, reason] :
       {std::pair(End::kNumeric, "NUMERIC"), std::pair(End::kBudgetSteps, "BUDGET_STEPS"),
        std::pair(End::kNotConverged, "NOT_CONVERGED")}) {
    EXPECT_EQ(after(end).to, v1::Job::FAILED) << reason;
    EXPECT_EQ(after(end).state_reason, reason);
    EXPECT_EQ(after(end).message, "here");
  }
  EXPECT_EQ(TransitionAfterFault("what").state_reason, "INTERNAL");
}

TEST(Lifecycle, MoveStampsTheTimesOfTheJob) {
  v1::Job job;
  Apply({v1::Job::QUEUED, reason::kWaitingForWorker}, kNow, &job);
  EXPECT_EQ(job.create_time().seconds(), 1);
  EXPECT_EQ(job.create_time().nanos(), 500'000'000);
  EXPECT_FALSE(job.has_start_time());
  Apply({v1::Job::RUNNING}, kNow + std::chrono::seconds(1), &job);
  EXPECT_EQ(job.start_time().seconds(), 2);
  EXPECT_FALSE(job.has_end_time());
  Apply({v1::Job::QUEUED, reason::kServerRestarted}, kNow + std::chrono::seconds(2), &job);
  EXPECT_EQ(job.create_time().seconds(), 1) << "it was created once";
  Apply({v1::Job::CANCELLED, reason::kUserRequest}, kNow + std::chrono::seconds(3), &job);
  EXPECT_EQ(job.end_time().seconds(), 4);
}

TEST(Lifecycle, EventTellsWhatTheJobTells) {
  v1::Job job;
  job.set_state(v1::Job::RUNNING);
  job.set_convergence(v1::Job::PARTIAL);
  const v1::Event event = Apply(TransitionAfterFault("it broke"), kNow, &job);
  EXPECT_EQ(event.state_changed().state(), v1::Job::FAILED);
  EXPECT_EQ(event.state_changed().state_reason(), job.state_reason());
  EXPECT_EQ(event.state_changed().message(), "it broke");
  EXPECT_EQ(event.state_changed().convergence(), v1::Job::PARTIAL);
  EXPECT_EQ(event.event_time().seconds(), job.end_time().seconds());
  EXPECT_EQ(job.error().message(), "it broke");
  EXPECT_NE(job.error().code(), 0);
}

}  // namespace
}  // namespace contact
