#include "launcher/wanted.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace contact::launcher {
namespace {

constexpr Limits kLimits{.min_workers = 0, .max_workers = 10, .threads = 4};
constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();

// Calls `check` with demands of all sizes.
template <class Check>
void ForAllDemands(Check check) {
  for (std::int64_t queued = 0; queued <= 60; ++queued) {
    for (std::int64_t running = 0; running <= 60; ++running) check(Demand{queued, running});
  }
}

TEST(WantedTest, NobodyIsWantedWhenThereIsNothingToDo) { EXPECT_EQ(Wanted({0, 0}, kLimits), 0); }

TEST(WantedTest, OneIsWantedAsSoonAsAnythingWaitsOrRuns) {
  EXPECT_EQ(Wanted({1, 0}, kLimits), 1);
  EXPECT_EQ(Wanted({0, 1}, kLimits), 1);
}

TEST(WantedTest, EveryJobHasAThreadUpToTheMostWorkers) {
  ForAllDemands([](const Demand& demand) {
    const int wanted = Wanted(demand, kLimits);
    if (wanted < kLimits.max_workers) {
      EXPECT_GE(wanted * kLimits.threads, demand.queued + demand.running);
    }
  });
}

TEST(WantedTest, NoWorkerHasNothingToDo) {
  ForAllDemands([](const Demand& demand) {
    EXPECT_LT((Wanted(demand, kLimits) - 1) * kLimits.threads, demand.queued + demand.running);
  });
}

TEST(WantedTest, MoreJobsNeverWantFewerWorkers) {
  ForAllDemands([](const Demand& demand) {
    EXPECT_LE(Wanted(demand, kLimits), Wanted({demand.queued + 1, demand.running}, kLimits));
    EXPECT_LE(Wanted(demand, kLimits), Wanted({demand.queued, demand.running + 1}, kLimits));
  });
}

TEST(WantedTest, AJobThatBeginsChangesNothing) {
  ForAllDemands([](const Demand& demand) {
    if (demand.queued == 0) return;
    EXPECT_EQ(Wanted(demand, kLimits), Wanted({demand.queued - 1, demand.running + 1}, kLimits));
  });
}

TEST(WantedTest, LimitsHoldWhateverIsAsked) {
  const Limits limits{.min_workers = 2, .max_workers = 3, .threads = 1024};
  EXPECT_EQ(Wanted({0, 0}, limits), 2);
  EXPECT_EQ(Wanted({kMany, kMany}, limits), 3);
  EXPECT_EQ(Wanted({-1, -1}, limits), 2);
}

TEST(WantedTest, CellsOfASweepWantWorkersAsWaitingJobsDo) {
  for (std::int64_t count = 0; count <= 60; ++count) {
    EXPECT_EQ(Wanted({.running = 1, .cells = count}, kLimits),
              Wanted({.queued = count, .running = 1}, kLimits));
  }
}

}  // namespace
}  // namespace contact::launcher
