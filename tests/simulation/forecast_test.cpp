// What is foretold of a run, against closed forms and the run itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulation/forecast/first_meeting.h"
#include "simulation/forecast/missing_contacts.h"
#include "simulation/forecast/run_estimate.h"
#include "simulation/kinds.h"
#include "testing/cases.h"

namespace contact {
namespace {

TEST(ImpactDuration, OfALinearContactIsHalfAPeriod) {
  EXPECT_NEAR(ImpactDuration(0.3, 2, 5e7, 1), std::numbers::pi * std::sqrt(0.3 / 5e7), 1e-16);
}

TEST(ImpactDuration, OfAnElasticCollisionIsThatOfTheRun) {
  for (const double n : {1.0, 1.5, 2.5}) {
    const testing::Record r = testing::RunAndRecord(testing::Collision(0.3, 2, 5e7, n, 1));
    ASSERT_EQ(r.cycles.size(), 1u);
    const double lasted = r.cycles[0].end_time - r.cycles[0].start_time;
    EXPECT_NEAR(ImpactDuration(0.3, 2, 5e7, n) / lasted, 1, 1e-9) << n;
  }
}

TEST(SwingPeriod, OfALinearContactIsThatOfItsSpring) {
  EXPECT_NEAR(SwingPeriod(0.3, 700, 5e7, 1), 2 * std::numbers::pi * std::sqrt(0.3 / 5e7), 1e-16);
}

TEST(FirstMeeting, OfAContactIsTheStartOfItsFirstCycle) {
  Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.7);
  s.bodies[0].position -= 0.01;
  s.loads = {{.body = 0, .constant = 30}};
  s.end_time = 0.01;
  const auto meetings = ForecastFirstMeetings(s);
  ASSERT_TRUE(meetings.at(0));
  const testing::Record r = testing::RunAndRecord(s);
  ASSERT_FALSE(r.cycles.empty());
  EXPECT_NEAR(meetings[0]->start, r.cycles[0].start_time, 1e-12);
  EXPECT_NEAR(meetings[0]->speed, r.cycles[0].approach_velocity, 1e-9);
}

TEST(FirstMeeting, IsNoneWhereNothingBringsTheSidesTogether) {
  const auto meets = [](const Scenario& s) { return ForecastFirstMeetings(s).at(0).has_value(); };
  Scenario s = testing::Chain({1, 1}, {1e8}, {0.5}, 0.5, 1);
  s.bodies[1].position += 0.3;
  EXPECT_TRUE(meets(s));
  s.end_time = 0.6 - 1e-9;  // Too early.
  EXPECT_FALSE(meets(s));
  s.end_time = 1;
  s.bodies[1].velocity = 0.5;  // Runs away as fast.
  EXPECT_FALSE(meets(s));
  s.loads = {{.body = 1, .constant = -1}};  // But is pushed back.
  EXPECT_TRUE(meets(s));
  s.bodies[0].fixed = s.bodies[1].fixed = true;
  s.bodies[0].velocity = s.bodies[1].velocity = 0;
  EXPECT_FALSE(meets(s));
}

// What a support between bodies does depends on both: nothing is said.
TEST(FirstMeeting, IsUnknownWhereBodiesAreTied) {
  Scenario s = testing::Chain({1, 1, 1}, {1e8, 1e8}, {0.5, 0.5}, 0.5, 1);
  s.bodies[1].position += 0.1;
  s.bodies[2].position += 0.2;
  EXPECT_TRUE(ForecastFirstMeetings(s).at(0));
  s.supports = {{.body = 1, .other = 2, .stiffness = 10}};
  EXPECT_FALSE(ForecastFirstMeetings(s).at(0));
}

// The spring gives its energy to the ball that it carries against the wall.
TEST(FirstMeeting, OfASpringHasTheSpeedOfItsEnergy) {
  Scenario s = testing::Collision(0.3, 0, 5e7, 1.5, 0.7);
  s.bodies[0].position -= 0.01;
  s.supports = {{.body = 0, .stiffness = 1000, .rest_position = 0.1}};
  s.end_time = 1;
  const auto meeting = ForecastFirstMeetings(s).at(0);
  ASSERT_TRUE(meeting);
  EXPECT_DOUBLE_EQ(meeting->swing, std::numbers::pi * std::sqrt(0.3 / 1000));
  const testing::Record r = [&] {
    s.end_time = 0.01;
    return testing::RunAndRecord(s);
  }();
  ASSERT_FALSE(r.cycles.empty());
  EXPECT_NEAR(meeting->speed / r.cycles[0].approach_velocity, 1, 1e-9);
  EXPECT_FALSE(meeting->driven);
}

TEST(FirstMeeting, AtRestUnderALoadLastsAsLongAsTheLoad) {
  Scenario s = testing::Collision(0.3, 0, 5e7, 1.5, 0.7);
  s.end_time = 1;
  EXPECT_FALSE(ForecastFirstMeetings(s).at(0));  // Nothing presses.
  s.loads = {{.body = 0, .constant = 60}};
  const auto steady = ForecastFirstMeetings(s).at(0);
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->speed, 0);
  EXPECT_EQ(steady->pressed, 1);
  EXPECT_DOUBLE_EQ(steady->push, 60 / 0.3);
  EXPECT_DOUBLE_EQ(steady->duration, SwingPeriod(0.3, 60, 5e7, 1.5));
  s.loads = {{.body = 0, .begin = 0.2, .end = 0.5, .constant = 60}};
  const auto pulse = ForecastFirstMeetings(s).at(0);
  ASSERT_TRUE(pulse);
  EXPECT_DOUBLE_EQ(pulse->pressed, 0.3);
  s.loads[0].constant = -60;  // Pulls.
  EXPECT_FALSE(ForecastFirstMeetings(s).at(0));
}

TEST(FirstMeeting, UnderASineThatNeverEndsIsDriven) {
  Scenario s = testing::SpringWall();
  const auto driven = ForecastFirstMeetings(s).at(0);
  ASSERT_TRUE(driven);
  EXPECT_TRUE(driven->driven);
  s.loads.pop_back();
  s.loads[0].constant = 1e5;
  const auto steady = ForecastFirstMeetings(s).at(0);
  ASSERT_TRUE(steady);
  EXPECT_FALSE(steady->driven);
}

Scenario Bodies(const std::vector<double>& positions) {
  Scenario s;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    s.bodies.push_back({.name = "B" + std::to_string(i + 1), .position = positions[i]});
  }
  return s;
}

std::vector<std::string> Missing(const Scenario& s) {
  std::vector<std::string> names;
  for (const Contact& contact : MissingContacts(s)) names.push_back(contact.name);
  return names;
}

TEST(MissingContacts, AreThoseOfNeighboursInTheOrderOfTheirPlaces) {
  Scenario s = Bodies({2, 0, 1});
  EXPECT_EQ(Missing(s), (std::vector<std::string>{"B2-B3", "B3-B1"}));
  s.contacts = {{.name = "C", .left = 1, .right = 2}};
  EXPECT_EQ(Missing(s), std::vector<std::string>{"B3-B1"});
  s.contacts.push_back({.name = "D", .left = 1, .right = 0});  // Not between neighbours.
  EXPECT_EQ(Missing(s), std::vector<std::string>{"B3-B1"});
}

TEST(MissingContacts, AreNoneWhereBodiesCannotMeet) {
  Scenario s = Bodies({0, 1});
  s.bodies[0].fixed = s.bodies[1].fixed = true;
  EXPECT_TRUE(Missing(s).empty());
  s.bodies[1].fixed = false;
  EXPECT_EQ(Missing(s).size(), 1U);
  s.contacts = {{.name = "wall", .left = kNone, .right = 1, .wall_position = 0.5}};
  EXPECT_TRUE(Missing(s).empty());
  s.contacts = {{.name = "wall", .left = 1, .right = kNone, .wall_position = 3}};
  EXPECT_EQ(Missing(s).size(), 1U);
}

TEST(MissingContacts, AreNoneWherePositionsAreNoPlaces) {
  Scenario s = Bodies({0, 0});
  EXPECT_TRUE(Missing(s).empty());
  s = Bodies({0, 1});
  s.bodies[0].radius = s.bodies[1].radius = 0.6;
  EXPECT_TRUE(Missing(s).empty());
}

TEST(RunEstimate, SamplesAreThoseOfTheRun) {
  for (const double interval : {1e-4, 3e-4, 7.1e-5, 4e-3}) {
    Scenario s = testing::TripleChain();
    s.sample_interval = interval;
    EXPECT_EQ(EstimateRunOf(s).samples, testing::RunAndRecord(s).rows()) << interval;
  }
  EXPECT_EQ(EstimateRunOf(testing::TripleChain()).samples, 0);
}

TEST(RunEstimate, SamplesInCyclesAreThoseOfTheRunWithinAFactorOfTwo) {
  for (Scenario s : {testing::Collision(0.3, 2, 5e7, 1.5, 0.7), testing::TripleChain()}) {
    s.sample_interval = s.end_time / 10;
    s.samples_per_contact = 100;
    const double ratio = EstimateRunOf(s).samples / testing::RunAndRecord(s).rows();
    EXPECT_LT(ratio, 2) << s.contacts.size();
    EXPECT_GT(ratio, 0.5) << s.contacts.size();
    s.most_contact_samples = 7;
    EXPECT_EQ(EstimateRunOf(s).samples, 11 + 7);
  }
}

// A ball that a spring and a force drive against a wall, a hundred contacts in ten intervals.
TEST(RunEstimate, ExtremesOfContactsWithoutSamplesAreThoseOfTheRunWithinAFactorOfTwo) {
  Scenario s = testing::SpringWall();
  s.end_time = 0.3;
  s.sample_interval = s.end_time / 10;
  s.samples_per_contact = 20;
  s.most_contact_samples = 10;
  s.turning_channels = 3;
  const double ratio = EstimateRunOf(s).samples / testing::RunAndRecord(s).rows();
  EXPECT_LT(ratio, 2);
  EXPECT_GT(ratio, 0.5);
}

TEST(RunEstimate, StepsAreThoseOfTheRunWithinAFactorOfThree) {
  Scenario law = testing::Collision(0.3, 2, 5e7, 1.5, 0.7);
  law.contacts[0].damping = DampingLaw::kFlores;
  Scenario fixed = law;
  fixed.solver.fixed_step = 1e-6;
  Scenario flight = law;
  flight.bodies[0].velocity = -2;
  flight.loads = {{.body = 0, .constant = -30}};
  for (const Scenario& s : {testing::Collision(0.3, 2, 5e7, 1.5, 0.7), law, fixed, flight}) {
    const double ratio =
        *EstimateRunOf(s).steps / static_cast<double>(testing::RunAndRecord(s).outcome.steps);
    EXPECT_LT(ratio, 3) << s.contacts.size();
    EXPECT_GT(ratio, 1.0 / 3) << s.contacts.size();
  }
}

TEST(RunEstimate, StepsAreNotToldWhereABodyTouchesTwoOthersOrASupportHoldsIt) {
  for (const Scenario& s : {testing::TripleChain(), testing::SpringWall()}) {
    const RunEstimate estimate = EstimateRunOf(s);
    EXPECT_FALSE(estimate.steps);
    EXPECT_FALSE(estimate.solve_seconds);
  }
}

TEST(RunEstimate, StepsOfRandomRunsAreWithinAFactorOfThreeForNineteenOfTwenty) {
  int told = 0;
  int good = 0;
  for (unsigned seed = 0; told < 100; ++seed) {
    for (const auto kind : {testing::Kind::kRow, testing::Kind::kGaps, testing::Kind::kBouncing}) {
      const Scenario s = testing::Dice(seed, kind).Roll();
      const auto steps = EstimateRunOf(s).steps;
      if (!steps) continue;
      const double ratio = *steps / static_cast<double>(testing::RunAndRecord(s).outcome.steps);
      ++told;
      good += ratio < 3 && ratio > 1.0 / 3 ? 1 : 0;
    }
  }
  EXPECT_GE(good, 0.95 * told);
}

// A ball that bounces on the ground has settled after some cycles, however long the run.
TEST(RunEstimate, GrowsWithTheRunUntilNothingIsLeftToBounce) {
  Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.5);
  s.loads = {{.body = 0, .constant = 3}};
  const auto cycles = [&](double end_time) {
    s.end_time = end_time;
    return EstimateRunOf(s).ledger_bytes;
  };
  EXPECT_LT(cycles(0.1), cycles(0.6));
  EXPECT_EQ(cycles(100), cycles(1000));
  s.contacts[0].restitution = 1;  // It never settles.
  EXPECT_LT(cycles(100), cycles(1000));
}

TEST(RunEstimate, OfABallThatNeverMeetsAnythingHasNoCycles) {
  Scenario s = testing::Collision(0.3, -2, 5e7, 1.5, 0.7);
  s.end_time = 1;
  EXPECT_EQ(EstimateRunOf(s).ledger_bytes, EstimateRunOf({}).ledger_bytes);
  s.solver.fixed_step = 1e-3;
  EXPECT_NEAR(*EstimateRunOf(s).steps, 1000, 1e-9);
}

TEST(RunEstimate, CountsNoMoreSensitivitiesThanAWindowHolds) {
  // A ball pressed against a wall bounces for ever: the longer the run, the more cycles.
  const auto memory_per_ledger = [](double from, double to) {
    Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.9999);
    s.loads = {{.body = 0, .constant = 1000}};
    s.end_time = from;
    const RunEstimate less = EstimateRunOf(s);
    s.end_time = to;
    const RunEstimate more = EstimateRunOf(s);
    return (more.memory_bytes - less.memory_bytes) / (more.ledger_bytes - less.ledger_bytes);
  };
  // While a pass differentiates by all groups a cycle takes its row and the sensitivities to its μ;
  // then its row only.
  EXPECT_GT(memory_per_ledger(0.005, 0.01), 0.9);
  EXPECT_LT(memory_per_ledger(1, 2), 0.7);
}

}  // namespace
}  // namespace contact
