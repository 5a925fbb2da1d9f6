// Two balls, one above the other, fall on a floor: who touches whom when decides how high they fly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "testing/cases.h"

namespace contact {
namespace {

struct Speeds {
  double lower, upper;
};

// Elastic Hertz contacts; the lower ball of mass `ratio` touches the floor, the upper one of mass 1
// is `gap` above it, both fall with 1 m/s. Speeds after all contacts.
Speeds Rebound(double ratio, double between, double gap) {
  Scenario s;
  s.bodies = {{.name = "lower", .mass = ratio, .velocity = -1},
              {.name = "upper", .mass = 1, .position = gap, .velocity = -1}};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1},
                {.name = "pair", .left = 0, .right = 1, .stiffness = between}};
  s.end_time = 200;
  const testing::Record r = testing::RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged) << ratio;
  return {r.outcome.velocities[0], r.outcome.velocities[1]};
}

// Computed by another integration of the same equations.
TEST(TwoBallDrop, TouchingBallsFlyAsComputedElsewhere) {
  struct Known {
    double ratio, lower, upper, softer;
  };
  for (const Known& known : {Known{1, 0.81368, 1.15669, 1.21084},
                             {2, 0.64543, 1.47202, 1.58850},
                             {3, 0.73361, 1.54450, 1.69878},
                             {5, 0.86450, 1.50440, 1.69879},
                             {10, 0.96925, 1.26708, 1.48862},
                             {20, 0.99788, 1.04155, 1.14303}}) {
    const Speeds both = Rebound(known.ratio, 1, 0);
    EXPECT_NEAR(both.lower, known.lower, 6e-6) << known.ratio;
    EXPECT_NEAR(both.upper, known.upper, 6e-6) << known.ratio;
    EXPECT_NEAR(Rebound(known.ratio, 1 / std::numbers::sqrt2, 0).upper, known.softer, 6e-6)
        << known.ratio;
    const double energy = known.ratio * both.lower * both.lower + both.upper * both.upper;
    EXPECT_NEAR(energy / (known.ratio + 1), 1, 1e-10) << known.ratio;
  }
}

// The lower ball has left the floor when they meet: two collisions of two.
TEST(TwoBallDrop, BallsApartFlyAsHardOnesDo) {
  for (const double ratio : {1.0, 2.0, 3.0, 5.0, 10.0, 20.0}) {
    EXPECT_NEAR(Rebound(ratio, 1, 30).upper, (3 * ratio - 1) / (ratio + 1), 1e-9) << ratio;
  }
}

}  // namespace
}  // namespace contact
