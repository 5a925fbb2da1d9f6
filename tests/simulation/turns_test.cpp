#include "simulation/course/turns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "simulation/run.h"
#include "testing/cases.h"

// Extremes between samples: a trajectory whose samples are rarer than the motion turns.

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// All of its channels.
Scenario Turning(Scenario s, double interval) {
  s.sample_interval = interval;
  s.turning_channels = static_cast<int>(s.contacts.size() + 2 * s.bodies.size());
  return s;
}

// A body on a spring: x = A cos ωt, sampled once in each period.
constexpr double kAmplitude = 1e-3, kOmega = 2000;

Scenario Swing() {
  Scenario s;
  s.bodies = {testing::Ball(kAmplitude)};
  s.supports = {{.body = 0, .stiffness = 0.5 * kOmega * kOmega}};
  s.end_time = 10.5 * 2 * std::numbers::pi / kOmega;
  return Turning(s, 2 * std::numbers::pi / kOmega);
}

std::vector<double> Column(const Record& r, int column) {
  std::vector<double> values;
  for (int row = 0; row < r.rows(); ++row) values.push_back(r.Sample(row, column));
  return values;
}

void ExpectLaterAndLater(const Record& r) {
  const std::vector<double> times = Column(r, 0);
  EXPECT_EQ(std::ranges::adjacent_find(times, std::greater_equal()), times.end());
}

TEST(Turns, ASwingSampledAtItsOwnPeriodReachesItsAmplitudeInEachOfThem) {
  const Scenario s = Swing();
  const Record r = RunAndRecord(s);
  ExpectLaterAndLater(r);
  for (int period = 0; period < 10; ++period) {
    double low = 0, high = 0, slow = 0, fast = 0;
    for (int row = 0; row < r.rows(); ++row) {
      const double passed = r.Sample(row, 0) / s.sample_interval - period;
      if (passed < -1e-9 || passed > 1 + 1e-9) continue;
      low = std::min(low, r.Sample(row, 1)), high = std::max(high, r.Sample(row, 1));
      slow = std::min(slow, r.Sample(row, 2)), fast = std::max(fast, r.Sample(row, 2));
    }
    EXPECT_NEAR(low, -kAmplitude, 1e-6 * kAmplitude) << period;
    EXPECT_NEAR(high, kAmplitude, 1e-6 * kAmplitude) << period;
    EXPECT_NEAR(slow, -kAmplitude * kOmega, 1e-6 * kAmplitude * kOmega) << period;
    EXPECT_NEAR(fast, kAmplitude * kOmega, 1e-6 * kAmplitude * kOmega) << period;
  }
}

TEST(Turns, EachIsASampleOfTheTrajectoryAtItsInstant) {
  const Record r = RunAndRecord(Swing());
  for (int row = 0; row < r.rows(); ++row) {
    const double phase = kOmega * r.Sample(row, 0);
    EXPECT_NEAR(r.Sample(row, 1), kAmplitude * std::cos(phase), 1e-8 * kAmplitude);
    EXPECT_NEAR(r.Sample(row, 2), -kAmplitude * kOmega * std::sin(phase),
                1e-8 * kAmplitude * kOmega);
  }
}

TEST(Turns, AreAtMostTwoOfEachChannelBetweenTwoSamples) {
  Scenario s = Swing();
  s.sample_interval = s.end_time / 2;  // Five periods.
  EXPECT_LE(RunAndRecord(s).rows(), 3 + 2 * 2 * 2);
}

TEST(Turns, OfMotionThatSamplesShowAreNone) {
  Scenario s = Swing();
  s.sample_interval /= 8;
  EXPECT_EQ(RunAndRecord(s).rows(), 85);  // At 0 and then 8 in each of 10.5 periods.
}

// It touches the floor several times between two samples.
Scenario Bounces() {
  Scenario s = testing::BouncingBall();
  s.end_time = 2;
  return Turning(s, 1.0 / 8);
}

// Between samples that lie in no cycle.
TEST(Turns, TheLargestForceOfAContactBetweenTwoSamplesIsThatOfTheLedger) {
  const Scenario s = Bounces();
  const Record r = RunAndRecord(s);
  ExpectLaterAndLater(r);
  const int force = 5;  // t, x, v, δ, δ̇, F.
  int compared = 0;
  for (int i = 0; i < 16; ++i) {
    const double from = i * s.sample_interval, until = from + s.sample_interval;
    const auto cut = [&](const Cycle& cycle) {
      const auto has = [&](double t) { return cycle.start_time <= t && t <= cycle.end_time; };
      return has(from) || has(until);
    };
    if (std::ranges::any_of(r.cycles, cut)) continue;
    double largest = 0, seen = 0;
    for (const Cycle& cycle : r.cycles) {
      const bool within = cycle.start_time > from && cycle.end_time < until;
      if (within) largest = std::max(largest, cycle.peak_force);
    }
    for (int row = 0; row < r.rows(); ++row) {
      const bool within = r.Sample(row, 0) > from && r.Sample(row, 0) < until;
      if (within) seen = std::max(seen, r.Sample(row, force));
    }
    EXPECT_NEAR(seen, largest, 1e-5 * largest) << i;
    if (largest > 0) ++compared;
  }
  EXPECT_GE(compared, 5);
}

// Round-off makes balls that lie on each other turn again and again.
TEST(Turns, WhatRestsHasNone) {
  for (const int balls : {1, 2, 3, 5}) {
    Scenario s = testing::Column(balls, 1e7, 0.5, 0.001);
    s.end_time = 3;
    const Record r = RunAndRecord(Turning(s, 0.1));
    int late = 0;
    for (int row = 0; row < r.rows(); ++row) late += r.Sample(row, 0) > 1.5 ? 1 : 0;
    EXPECT_EQ(late, 15) << balls;
  }
}

TEST(Turns, OfForcesAloneTakeNothingOfBodies) {
  Scenario s = Bounces();
  s.turning_channels = 1;
  const Record r = RunAndRecord(s), all = RunAndRecord(Bounces());
  EXPECT_GT(r.rows(), 17);
  EXPECT_LT(r.rows(), all.rows());
}

// A gas is solved in clusters, each with a clock of its own. In these, round-off decides of which
// sign a force is where a contact ends, and which of two equal turns is larger.
TEST(Turns, InClustersAreThoseOfTheWhole) {
  for (const unsigned seed : {3U, 9U, 21U, 23U, 30U}) {
    const Scenario s = testing::Gas(8, 1e8, seed);
    const Scenario turning = Turning(s, s.end_time / 3);
    const Record parts = RunAndRecord(turning);
    const Record whole = testing::RunTogether(turning);
    ExpectLaterAndLater(parts);
    EXPECT_GT(parts.rows(), 4);
    ASSERT_EQ(parts.rows(), whole.rows()) << seed;
    for (int row = 0; row < parts.rows(); ++row) {
      EXPECT_NEAR(parts.Sample(row, 0), whole.Sample(row, 0), 1e-6 * s.end_time) << row;
    }
  }
}

// Balls that fly up and fall, and a table that swings below them.
TEST(Turns, OfFlightsAndOfATableInClustersAreThoseOfTheWhole) {
  Scenario s = testing::Gas(8, 1e8, 3);
  for (int b = 0; b < 8; ++b) s.loads.push_back({.body = b, .constant = -0.3});
  const double omega = 2 * std::numbers::pi * 30;
  s.drives.push_back({.body = 8, .amplitude = 1e-3, .angular_frequency = omega});
  s.bodies.push_back({.name = "table", .velocity = 1e-3 * omega, .fixed = true});
  s.contacts[0].left = 8;
  s = Turning(s, s.end_time / 3);
  const Record parts = RunAndRecord(s), whole = testing::RunTogether(s);
  ExpectLaterAndLater(parts);
  ASSERT_EQ(parts.rows(), whole.rows());
  for (int row = 0; row < parts.rows(); ++row) {
    EXPECT_NEAR(parts.Sample(row, 0), whole.Sample(row, 0), 1e-4 * s.end_time) << row;
  }
}

}  // namespace
}  // namespace contact
