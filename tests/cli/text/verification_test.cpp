#include "cli/text/comparison/verification.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/text/comparison/render_verification.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

v1::Scenario SolvedBalls() {
  v1::Scenario scenario;
  scenario.add_bodies()->set_name("A");
  scenario.mutable_bodies(0)->set_velocity_m_per_s(1);
  scenario.set_end_time_s(1);
  return scenario;
}

v1::Scenario WithStep(double step) {
  v1::Scenario scenario = SolvedBalls();
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  scenario.mutable_solver()->set_step_s(step);
  return scenario;
}

v1::Scenario WithTolerance(double tolerance) {
  v1::Scenario scenario = SolvedBalls();
  scenario.mutable_solver()->set_relative_tolerance(tolerance);
  return scenario;
}

// What a method of this order makes of the scenario: μ is 2e8, the velocity 0.3 m/s, and the error
// at the resolution 1 is `error`, relative.
v1::Job Solved(const std::string& name, double resolution, double error, double order) {
  const double factor = 1 + error * std::pow(resolution, order);
  v1::Job job;
  job.set_name(name);
  *job.mutable_scenario() = WithStep(1e-6);
  job.add_final_bodies()->set_name("A");
  job.mutable_final_bodies(0)->set_velocity_m_per_s(0.3 * factor);
  v1::Cycle& cycle = *job.add_cycles();
  cycle.set_contact("A-B");
  cycle.set_number(1);
  cycle.set_status(v1::Cycle::CONVERGED);
  cycle.set_restitution_in(0.5);
  cycle.set_mu(2e8 * factor);
  cycle.set_peak_force_n(100 * factor);
  return job;
}

v1::Job JobWithError(double error) { return Solved("jobs/own", 1, error, 1); }

std::vector<v1::Job> RunsOf(double error, double order) {
  return {Solved("jobs/2", 0.5, error, order), Solved("jobs/4", 0.25, error, order),
          Solved("jobs/8", 0.125, error, order)};
}

const RefinementPlan kHalves = PlanOf(WithStep(1e-6));

// The job and its runs, whose errors are of this order.
Verification Verified(double error, double order, double tolerance = 1e-8) {
  return Verify(kHalves, JobWithError(error), RunsOf(error, order), tolerance);
}

TEST(RefinementPlan, HalvesTheStepThreeTimes) {
  EXPECT_EQ(kHalves.own, 1e-6);
  EXPECT_THAT(kHalves.resolutions, ElementsAre(5e-7, 2.5e-7, 1.25e-7));
  EXPECT_EQ(kHalves.Field(), "solver.step_s");
  EXPECT_EQ(kHalves.At(5e-7, WithStep(1e-6)).solver().step_s(), 5e-7);
  v1::Scenario standard = WithStep(1);
  standard.mutable_solver()->clear_step_s();
  EXPECT_EQ(PlanOf(standard).resolutions, kHalves.resolutions);
}

TEST(RefinementPlan, DividesTheToleranceByTenAsFarAsTheContractAllows) {
  const RefinementPlan plan = PlanOf(WithTolerance(3e-9));
  EXPECT_THAT(plan.resolutions, ElementsAre(3e-10, 3e-11, 3e-12));
  EXPECT_EQ(plan.Field(), "solver.relative_tolerance");
  EXPECT_EQ(plan.At(3e-10, WithTolerance(3e-9)).solver().relative_tolerance(), 3e-10);
  for (const double own : {1e-11, 2e-12, 1e-13}) {
    EXPECT_EQ(PlanOf(WithTolerance(own)).own, own);
    EXPECT_THAT(PlanOf(WithTolerance(own)).resolutions, ElementsAre(1e-11, 1e-12, 1e-13));
  }
}

TEST(RefinementPlan, SolvesMuAThousandTimesAsExactly) {
  v1::Scenario scenario = WithStep(1e-6);
  EXPECT_EQ(kHalves.At(5e-7, scenario).solver().restitution_tolerance(), 1e-11);
  scenario.mutable_solver()->set_restitution_tolerance(1e-12);
  EXPECT_EQ(PlanOf(scenario).At(5e-7, scenario).solver().restitution_tolerance(), 1e-12);
}

TEST(RefinementPlan, AllowsFinerRunsMoreSteps) {
  v1::Scenario scenario = WithStep(1e-6);
  EXPECT_EQ(kHalves.At(1.25e-7, scenario).solver().max_steps(), 800'000'000);
  scenario.mutable_solver()->set_max_steps(1'000'000'000'000);
  EXPECT_EQ(kHalves.At(1.25e-7, scenario).solver().max_steps(), 1'000'000'000'000);
}

TEST(RefinementPlan, OrderOfRk4IsLessWhereForcesBeginRoughly) {
  v1::Scenario scenario = WithStep(1e-6);
  EXPECT_EQ(PlanOf(scenario).order, 4);
  scenario.add_bodies()->set_name("B");
  for (v1::Body& body : *scenario.mutable_bodies()) body.set_mass_kg(1);
  scenario.mutable_bodies(1)->set_position_m(1);
  v1::Contact& contact = *scenario.add_contacts();
  contact.add_between("A");
  contact.add_between("B");
  contact.set_stiffness(1e6);
  contact.set_restitution(0.5);
  EXPECT_EQ(PlanOf(scenario).order, 2.5);
  contact.set_damping(v1::Contact::HERTZ_QUARTER_POWER);
  EXPECT_EQ(PlanOf(scenario).order, 1.25);
  contact.clear_damping();
  contact.set_exponent(3);
  EXPECT_EQ(PlanOf(scenario).order, 4);
  scenario.mutable_solver()->Clear();
  EXPECT_EQ(PlanOf(scenario).order, 0);
}

TEST(Verification, FindsTheOrderAndWhatTheJobIsOff) {
  const Verification verification = Verified(1e-6, 4);
  ASSERT_EQ(verification.numbers.size(), 3U);
  for (const auto& number : verification.numbers) {
    EXPECT_TRUE(verification.ShowsOrder(number)) << number.name;
    EXPECT_NEAR(number.refinement.order, 4, 1e-2);
    EXPECT_FALSE(number.Holds());
  }
  EXPECT_NEAR(verification.numbers[0].distance, 0.3e-6, 1e-11);  // Of the largest speed, 1 m/s.
  EXPECT_NEAR(verification.numbers[1].distance, 1e-6, 1e-11);
  EXPECT_NEAR(verification.numbers[2].refinement.limit, 2e8, 1e-3);
  EXPECT_FALSE(verification.Holds());
  EXPECT_TRUE(Verified(0.9e-8, 4).Holds());
}

TEST(Verification, AnotherOrderIsToldAndIsNoFault) {
  const Verification verification = Verified(1e-9, 2.5);
  EXPECT_NEAR(verification.numbers[0].refinement.order, 2.5, 1e-2);
  EXPECT_FALSE(verification.ShowsOrder(verification.numbers[0]));
  EXPECT_TRUE(verification.Holds());
}

TEST(Verification, NumbersThatDoNotSettleAreAsFarAsTheRunsAreApart) {
  std::vector<v1::Job> runs = RunsOf(0, 4);
  runs[1].mutable_cycles(0)->set_peak_force_n(100.5);
  const Verification verification = Verify(kHalves, JobWithError(0), runs, 1e-8);
  EXPECT_NEAR(verification.numbers[1].distance, 0.005, 1e-12);
  for (const std::size_t i : {1U, 2U}) {
    runs = RunsOf(0, 4);
    runs[i].mutable_cycles(0)->set_peak_force_n(NAN);
    EXPECT_FALSE(Verify(kHalves, JobWithError(0), runs, 1).Holds());
  }
}

TEST(Verification, WhatTheIterationLeavesIsNoDifference) {
  std::vector<v1::Job> runs = RunsOf(1e-9, 1);
  EXPECT_NEAR(Verify(kHalves, JobWithError(0), runs, 1e-8).numbers[1].refinement.order, 1, 1e-3);
  v1::Group& group = *runs[0].add_groups();
  group.set_restitution_in(0.5);
  group.set_restitution_out(0.5 * (1 + 5e-9));
  EXPECT_TRUE(std::isnan(Verify(kHalves, JobWithError(0), runs, 1e-8).numbers[1].refinement.order));
}

TEST(Verification, MuMayBeFartherOffWhereItIsMoreSensitive) {
  v1::Job job = JobWithError(0);
  std::vector<v1::Job> runs = RunsOf(0, 4);
  job.mutable_cycles(0)->set_mu(2e8 * (1 + 9e-8));
  EXPECT_FALSE(Verify(kHalves, job, runs, 1e-8).Holds());
  job.mutable_cycles(0)->set_restitution_in(0.9);
  EXPECT_TRUE(Verify(kHalves, job, runs, 1e-8).Holds());
}

TEST(Verification, MatchesCyclesByContactAndNumberAndTellsWhatDiffers) {
  std::vector<v1::Job> runs = RunsOf(0, 4);
  for (const std::size_t i : {1U, 2U}) {
    runs[i].add_cycles()->CopyFrom(runs[i].cycles(0));
    runs[i].mutable_cycles(0)->set_number(2);
    runs[i].mutable_cycles(0)->set_peak_force_n(7);
  }
  runs[2].mutable_cycles(1)->set_status(v1::Cycle::JUMP);
  const Verification verification = Verify(kHalves, JobWithError(0), runs, 1e-8);
  EXPECT_THAT(
      verification.differences,
      ElementsAre("A-B has 1, 1, 2, 2 cycles", AllOf(HasSubstr("A-B #1 is "), HasSubstr(" JUMP"))));
  EXPECT_EQ(verification.numbers.size(), 2U);  // Its μ was not found everywhere.
  EXPECT_TRUE(verification.Holds());
}

TEST(Verification, OfWhatStaysZeroNothingIsTold) {
  v1::Job job = JobWithError(0);
  std::vector<v1::Job> runs = RunsOf(0, 4);
  job.mutable_final_bodies(0)->set_velocity_m_per_s(0);
  for (v1::Job& run : runs) run.mutable_final_bodies(0)->set_velocity_m_per_s(0);
  EXPECT_EQ(Verify(kHalves, job, runs, 1e-8).numbers.size(), 2U);
}

TEST(RenderVerification, ShowsRunsNumbersAndVerdict) {
  const std::string text = RenderVerification(Verified(1e-6, 4), false, {});
  EXPECT_THAT(text,
              AllOf(HasSubstr("STEP [s]"), HasSubstr("jobs/own\n"), Not(HasSubstr("jobs/2"))));
  EXPECT_THAT(text,
              AllOf(HasSubstr("A-B #1 μ [N·s/m^(n+1)]  200000200 "), HasSubstr(" 200000012.5 "),
                    HasSubstr("4.00"), HasSubstr("1.0e-06  FAR")));
  EXPECT_THAT(text,
              HasSubstr("\norder 4, that of RK4 here, is shown by 3 of 3 numbers\nNOT VERIFIED"));
  EXPECT_THAT(RenderVerification(Verified(1e-6, 4, 1e-5), true, {}),
              AllOf(HasSubstr("jobs/8\n"), HasSubstr("verified: all within 1e-05")));
}

TEST(RenderVerification, TellsOfTolerancesHowMuchTheLastOneMoves) {
  const RefinementPlan plan = PlanOf(WithTolerance(1e-9));
  const std::string text =
      RenderVerification(Verify(plan, JobWithError(0), RunsOf(8e-9, 3), 1e-8), false, {});
  EXPECT_THAT(text, HasSubstr("TOLERANCE"));
  EXPECT_THAT(text, HasSubstr("from 1e-11 to 1e-12 no number moves by more than 1.1e-10\n"));
}

TEST(RenderVerification, JsonHasEveryNumberAndNothingForNone) {
  const json document = json::parse(VerificationJson(Verified(0, 4), false));
  EXPECT_EQ(document["job"]["job"], "jobs/own");
  EXPECT_EQ(document["field"], "solver.step_s");
  EXPECT_EQ(document["order"], 4);
  EXPECT_EQ(document["runs"][2]["value"], 1.25e-7);
  EXPECT_EQ(document["runs"][2]["job"], nullptr);
  EXPECT_EQ(document["holds"], true);
  EXPECT_THAT(document["differences"], IsEmpty());
  EXPECT_EQ(document["numbers"][0]["values"].size(), 3U);
  EXPECT_EQ(document["numbers"][0]["order"], nullptr);
  EXPECT_EQ(document["numbers"][0]["richardson"], 0.3);
}

}  // namespace
}  // namespace contact::cli
