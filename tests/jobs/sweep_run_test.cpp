#include "jobs/run/sweep_run.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// Nine cells of a ball that flies freely.
v1::Sweep Flights() {
  v1::Sweep sweep;
  v1::Body& ball = *sweep.mutable_base()->add_bodies();
  ball.set_name("ball");
  ball.set_mass_kg(0.5);
  sweep.mutable_base()->set_end_time_s(1e-3);
  v1::Sweep::Axis& axis = *sweep.add_axes();
  axis.set_field("bodies[0].velocity_m_per_s");
  for (int i = 0; i < 9; ++i) axis.add_values(i);
  return sweep;
}

class SweepRunTest : public testing::Test {
 protected:
  SweepRun Begin(std::vector<bool> done = std::vector<bool>(9)) {
    return {Flights(),
            DecodeSweep(Flights()),
            std::move(done),
            clock_,
            options_,
            control_,
            {[this](const SolvedCell& solved) { computed_.insert(solved.cell.index()); }, [] {},
             [this](const CellCounts& counts) { counted_ += counts.cells; }}};
  }
  void ComputeAll(SweepRun* run) {
    while (run->Work(1h, [] { return false; })) {
    }
  }

  FakeClock clock_;
  JobOptions options_;
  std::shared_ptr<RunControl> control_ = std::make_shared<RunControl>();
  std::multiset<int> computed_;
  int counted_ = 0;
};

TEST_F(SweepRunTest, LentCellsAreNotComputedHereAndTheRunWaitsForThem) {
  SweepRun run = Begin();
  const auto lent = run.Lend(4);
  ASSERT_TRUE(lent);
  EXPECT_EQ(lent->count(), 4);
  EXPECT_EQ(run.waiting(), 5);
  ComputeAll(&run);
  EXPECT_EQ(computed_, (std::multiset{4, 5, 6, 7, 8}));
  EXPECT_FALSE(run.Lend(1)) << "there are none left";
  EXPECT_FALSE(run.AwaitEnd(0ms));
  run.Returned({.cells = 4, .steps = 7});
  EXPECT_TRUE(run.AwaitEnd(0ms));
  EXPECT_EQ(counted_, 4);
  EXPECT_GE(control_->signs(), 7);
}

TEST_F(SweepRunTest, CellsThatComeBackAreComputedHere) {
  SweepRun run = Begin();
  const auto lent = run.Lend(9);
  ASSERT_TRUE(lent);
  run.PutBack(*lent);
  EXPECT_EQ(run.waiting(), 9);
  ComputeAll(&run);
  EXPECT_EQ(computed_, (std::multiset{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(run.AwaitEnd(0ms));
}

TEST_F(SweepRunTest, CellsOfAnEarlierAttemptAreNotLent) {
  SweepRun run = Begin({true, false, false, true, false, true, true, true, true});
  const auto first = run.Lend(9);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->first, 1);
  EXPECT_EQ(first->last, 2);
  const auto second = run.Lend(9);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->first, 4);
  EXPECT_EQ(second->count(), 1);
  EXPECT_FALSE(run.Lend(9));
  EXPECT_EQ(run.waiting(), 0);
}

TEST_F(SweepRunTest, NothingIsLentOnceTheRunIsToStop) {
  SweepRun run = Begin();
  control_->Stop();
  EXPECT_FALSE(run.Lend(1));
}

}  // namespace
}  // namespace contact
