#include "simulation/statics/equilibrium.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "simulation/model/index.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Ball;
using ::testing::IsEmpty;
using ::testing::Not;

// Balls above a floor at 0, in gaps.
Scenario Pile(const std::vector<double>& masses, double gap, double exponent = 1.5) {
  Scenario s;
  for (int i = 0; i < std::ssize(masses); ++i) {
    s.bodies.push_back(Ball(0.05 + gap + (0.1 + gap) * i, 0, masses[At(i)]));
    s.loads.push_back({.body = i, .constant = -9.81 * masses[At(i)]});
    s.contacts.push_back({.name = std::to_string(i),
                          .left = i - 1,
                          .right = i,
                          .stiffness = 1e7,
                          .exponent = exponent});
  }
  s.end_time = 0.01;
  return s;
}

// Each contact carries the weight of all above it: δ = (W/k)^{1/n}.
TEST(Equilibrium, EachContactOfAPileCarriesWhatStandsOnIt) {
  for (const double gap : {-1e-3, 0.0, 1e-6, 0.5}) {
    for (const double exponent : {1.0, 1.5, 4.0}) {
      const std::vector<double> masses = {0.2, 3, 0.01, 1};
      const Equilibrium found = FindEquilibrium(Pile(masses, gap, exponent));
      ASSERT_THAT(found.unheld, IsEmpty()) << gap << " " << exponent;
      double weight = 9.81 * (0.2 + 3 + 0.01 + 1), face = 0;
      for (std::size_t i = 0; i < masses.size(); ++i) {
        face += 0.05 - std::pow(weight / 1e7, 1 / exponent);
        EXPECT_NEAR(found.positions[i], face, 1e-13) << gap << " " << exponent << " " << i;
        face += 0.05;
        weight -= 9.81 * masses[i];
      }
    }
  }
}

TEST(Equilibrium, SpringsAndContactsShareALoad) {
  Scenario s = Pile({1}, 0, 1);
  s.supports = {{.body = 0, .stiffness = 3e7, .rest_position = 0.05}};
  EXPECT_NEAR(FindEquilibrium(s).positions[0], 0.05 - 9.81 / 4e7, 1e-15);
}

TEST(Equilibrium, LoadsAreThoseOfTimeZero) {
  Scenario s = Pile({1}, 0, 1);
  s.loads = {{.body = 0, .amplitude = 20, .angular_frequency = 3, .phase = -0.5},
             {.body = 0, .begin = 1, .constant = -1e6}};
  EXPECT_NEAR(FindEquilibrium(s).positions[0], 0.05 - 20 * std::sin(0.5) / 1e7, 1e-15);
}

TEST(Equilibrium, WhatNothingHoldsIsNamed) {
  Scenario s = Pile({1, 2, 3}, 1e-3);
  s.bodies.push_back(Ball(10));
  s.loads.push_back({.body = 3, .constant = -1});
  ASSERT_THAT(FindEquilibrium(s).unheld, Not(IsEmpty()));
  EXPECT_EQ(FindEquilibrium(s).unheld[0], 3);
  s.loads[3].constant = 0;
  EXPECT_THAT(FindEquilibrium(s).unheld, IsEmpty());
  s.loads[2].constant = 100;  // The upper one is lifted off.
  ASSERT_THAT(FindEquilibrium(s).unheld, Not(IsEmpty()));
  EXPECT_EQ(FindEquilibrium(s).unheld[0], 2);
}

TEST(Equilibrium, WhatNothingMovesStaysWhereItIs) {
  Scenario s = Pile({1, 2}, 0);
  s.bodies.push_back(Ball(10));        // Nothing acts on it.
  s.bodies.push_back(Ball(0.25, -2));  // It flies, and presses nothing.
  s.contacts.push_back({.name = "blow", .left = 1, .right = 3, .stiffness = 1e7});
  const Equilibrium found = FindEquilibrium(s);
  EXPECT_THAT(found.unheld, IsEmpty());
  EXPECT_EQ(found.positions[2], 10);
  EXPECT_EQ(found.positions[3], 0.25);
}

TEST(Equilibrium, BodiesThatNothingHoldsInPlaceAreLoose) {
  using ::testing::ElementsAre;
  Scenario s = Pile({1, 2}, -1e-3);
  s.bodies.push_back(Ball(10));      // Nothing holds it,
  s.bodies.push_back(Ball(20));      // nor these two, which a spring joins,
  s.bodies.push_back(Ball(21));      //
  s.bodies.push_back(Ball(30, -2));  // and this one flies.
  s.supports = {{.body = 3, .other = 4, .stiffness = 1e5}};
  EXPECT_THAT(FindLoose(s), ElementsAre(2, 3, 4));
  s.supports.push_back({.body = 4, .stiffness = 1});
  EXPECT_THAT(FindLoose(s), ElementsAre(2));
  s.bodies[2].fixed = true;
  EXPECT_THAT(FindLoose(s), IsEmpty());
  s.bodies[1].position += 0.01;  // Lifted off.
  EXPECT_THAT(FindLoose(s), ElementsAre(1));
}

TEST(Equilibrium, OfALongRowIsFoundForEveryExponent) {
  for (const double exponent : {1.0, 1.5, 5.0}) {
    const Scenario s = Pile(std::vector<double>(1000, 1.0), 0, exponent);
    const Equilibrium found = FindEquilibrium(s);
    ASSERT_THAT(found.unheld, IsEmpty()) << exponent;
    const double lowest = 0.05 - std::pow(9810 / 1e7, 1 / exponent);
    EXPECT_NEAR(found.positions[0], lowest, 1e-9) << exponent;
  }
}

// By the equations of motion: what stands there stays there.
TEST(Equilibrium, OfRandomPilesIsWhereNothingMoves) {
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const auto log = [&](double low, double high) {
    return low * std::pow(high / low, uniform(0, 1));
  };
  for (int i = 0; i < 150; ++i) {
    Scenario s;
    const int balls = 1 + static_cast<int>(uniform(0, i % 10 == 0 ? 40 : 6));
    double top = log(1e-6, 1);
    for (int b = 0; b < balls; ++b) {
      s.bodies.push_back(Ball(top + 0.05, 0, log(0.01, 10)));
      top += 0.1 + (uniform(0, 1) < 0.5 ? log(1e-6, 0.1) : 0);
      s.loads.push_back({.body = b, .constant = -9.81 * s.bodies.back().mass});
      s.contacts.push_back({.name = std::to_string(b),
                            .left = b - 1,
                            .right = b,
                            .stiffness = log(1e4, 1e10),
                            .exponent = uniform(0, 1) < 0.5 ? 1.5 : uniform(1, 3),
                            .restitution = uniform(0.3, 1)});
    }
    if (uniform(0, 1) < 0.3) s.loads.push_back({.body = balls - 1, .constant = -log(1e-2, 1e4)});
    if (uniform(0, 1) < 0.3) {
      s.supports.push_back({.body = static_cast<int>(uniform(0, balls)),
                            .stiffness = log(1e2, 1e8),
                            .rest_position = s.bodies[0].position});
    }
    const Equilibrium found = FindEquilibrium(s);
    ASSERT_THAT(found.unheld, IsEmpty()) << i;
    for (std::size_t b = 0; b < s.bodies.size(); ++b) s.bodies[b].position = found.positions[b];
    s.starts_at_rest = true;
    s.end_time = 0.01;
    const testing::Record r = testing::RunAndRecord(s);
    for (const double v : r.outcome.velocities) EXPECT_LT(std::abs(v), 1e-9) << i;
    for (const Cycle& cycle : r.cycles) EXPECT_EQ(cycle.status, Cycle::Status::kSettled) << i;
    EXPECT_LT(r.outcome.steps, 20'000) << i;
  }
}

}  // namespace
}  // namespace contact
