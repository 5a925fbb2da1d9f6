#include "wire/estimate.h"

#include <gmock/gmock.h>

#include "wire/scenario_builder.h"

namespace contact {
namespace {

// How well it foretells what runs take is tested with the scenarios that are shipped, in
// tests/python/estimate_test.py.

v1::Estimate EstimateOf(const v1::Scenario& message) {
  const DecodedScenario decoded = DecodeScenario(message);
  EXPECT_THAT(Lines(decoded.violations), testing::IsEmpty());
  return EstimateRun(decoded.scenario);
}

v1::Scenario Apart() {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_bodies(0)->set_velocity_m_per_s(-0.2);
  return scenario;
}

TEST(Estimate, FreeFlightInFixedStepsIsKnownExactly) {
  v1::Scenario scenario = Apart();
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  EXPECT_EQ(EstimateOf(scenario).steps(), 4000);
  scenario.mutable_solver()->set_step_s(1e-5);
  EXPECT_EQ(EstimateOf(scenario).steps(), 400);
}

TEST(Estimate, SamplesAreThoseThatAreRecorded) {
  v1::Scenario scenario = TwoBalls();
  EXPECT_EQ(EstimateOf(scenario).samples(), 1001);
  scenario.mutable_output()->set_sample_interval_s(3e-4);
  EXPECT_EQ(EstimateOf(scenario).samples(), 14 + 14);  // The contact would have 20 of its own.
  scenario.mutable_output()->set_samples_per_contact(0);
  EXPECT_EQ(EstimateOf(scenario).samples(), 14);
  scenario.mutable_output()->set_ledger_only(true);
  EXPECT_EQ(EstimateOf(scenario).samples(), 0);
}

TEST(Estimate, ContactsThatNeverMeetTakeNoSteps) {
  EXPECT_LT(EstimateOf(Apart()).steps(), 10);
  EXPECT_GT(EstimateOf(TwoBalls()).steps(), 40);
}

TEST(Estimate, DampingThatIsIteratedTakesMorePasses) {
  v1::Scenario scenario = TwoBalls();
  const std::int64_t iterated = EstimateOf(scenario).steps();
  scenario.mutable_contacts(0)->set_damping(v1::Contact::EXACT);
  EXPECT_LT(EstimateOf(scenario).steps(), iterated);
}

TEST(Estimate, HugeRunsDoNotOverflow) {
  v1::Scenario scenario = Apart();
  scenario.set_end_time_s(1e6);
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  scenario.mutable_solver()->set_step_s(1e-300);
  const v1::Estimate estimate = EstimateOf(scenario);
  EXPECT_EQ(estimate.steps(), 9'000'000'000'000'000'000);
  EXPECT_EQ(estimate.wall_time().seconds(), 300'000'000'000);
}

TEST(Estimate, ASweepTakesWhatItsCellsDoAndKeepsWhatItIsAskedTo) {
  v1::Sweep sweep;
  *sweep.mutable_base() = TwoBalls();
  sweep.add_metrics("iterations");
  sweep.add_axes()->set_field("bodies[0].velocity_m_per_s");
  for (const double velocity : {0.2, 0.3, 0.4}) sweep.mutable_axes(0)->add_values(velocity);
  const v1::Estimate none = EstimateSweep(sweep, DecodeSweep(sweep));
  EXPECT_EQ(none.steps(), 3 * EstimateOf(TwoBalls()).steps());
  EXPECT_EQ(none.samples(), 0);
  sweep.add_keep_trajectories(1);
  const v1::Estimate kept = EstimateSweep(sweep, DecodeSweep(sweep));
  EXPECT_EQ(kept.samples(), 1001);
  EXPECT_GT(kept.output_bytes(), none.output_bytes() + 1001L * 8);
}

}  // namespace
}  // namespace contact
