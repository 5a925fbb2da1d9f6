#include "translate/impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/laws/isolated_collision.h"
#include "translate/damping.h"

namespace contact::translate {
namespace {

constexpr double kPi = std::numbers::pi;

ForceLaw Linear(Pull pull, double ratio = 0) { return {.damping = 2 * ratio, .pull = pull}; }

double Delivered(Pull pull, double ratio) {
  return Collide(Linear(pull, ratio), {}).velocity_ratio;
}

double RatioFor(Pull pull, double restitution) {
  return DampingFor(Linear(pull), restitution).value() / 2;
}

// Closed forms of the restitution of a linear spring and damper, over ζ < 1.
double Pulling(double z) { return std::exp(-kPi * z / std::sqrt(1 - z * z)); }

double Clamped(double z) {
  const double s = std::sqrt(1 - z * z);
  return std::exp(-z / s * (kPi - std::atan2(2 * z * s, 1 - 2 * z * z)));
}

double UndampedReturn(double z) { return std::exp(-z * std::acos(z) / std::sqrt(1 - z * z)); }

TEST(Impact, ALinearLawGivesBackWhatItsClosedFormSays) {
  for (const double z : {0.01, 0.1, 0.3, 0.6, 0.9}) {
    EXPECT_NEAR(Delivered(Pull::kAllowed, z), Pulling(z), 1e-8) << z;
    EXPECT_NEAR(Delivered(Pull::kClamped, z), Clamped(z), 1e-8) << z;
    EXPECT_NEAR(Delivered(Pull::kUndampedReturn, z), UndampedReturn(z), 1e-8) << z;
  }
}

struct Row {
  double restitution, pulling, clamped, undamped, limited, clamped_gives, limited_gives;
};

// ζ for a restitution, and what B and D give back with the ζ of A.
constexpr Row kRows[] = {
    {0.95, 0.016325, 0.016498, 0.033344, 0.01668, 0.95051, 0.95101},
    {0.9, 0.033518, 0.034265, 0.070035, 0.03508, 0.90203, 0.90405},
    {0.8, 0.070850, 0.074355, 0.155848, 0.07859, 0.80810, 0.81612},
    {0.7, 0.112808, 0.122215, 0.263878, 0.13498, 0.71820, 0.73597},
    {0.6, 0.160493, 0.180858, 0.404744, 0.21245, 0.63229, 0.66311},
    {0.5, 0.215454, 0.255276, 0.597342, 0.32671, 0.55028, 0.59677},
    {0.4, 0.279998, 0.354508, 0.879039, 0.50870, 0.47201, 0.53587},
    {0.3, 0.357857, 0.497239, 1.336027, 0.82435, 0.39714, 0.47899},
};

TEST(Impact, TheDampingOfFourLinearLawsIsThatOfTheTable) {
  for (const Row& row : kRows) {
    EXPECT_NEAR(RatioFor(Pull::kAllowed, row.restitution), row.pulling, 1e-6);
    EXPECT_NEAR(RatioFor(Pull::kClamped, row.restitution), row.clamped, 1e-6);
    EXPECT_NEAR(RatioFor(Pull::kUndampedReturn, row.restitution), row.undamped, 1e-6);
    EXPECT_NEAR(RatioFor(Pull::kLimitedDamper, row.restitution), row.limited, 1e-5);
  }
}

TEST(Impact, WithTheDampingOfTextbooksOtherLawsGiveBackMore) {
  for (const Row& row : kRows) {
    const double ratio = DampingRatio(row.restitution);
    EXPECT_NEAR(Delivered(Pull::kClamped, ratio), row.clamped_gives, 1e-5);
    EXPECT_NEAR(Delivered(Pull::kLimitedDamper, ratio), row.limited_gives, 1e-5);
  }
}

TEST(Impact, ADamperOfTheSpringsExponentIsThatOfHuntAndCrossley) {
  for (const double e : {0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.1}) {
    for (const double n : {1.0, 1.5, 3.0}) {
      const ForceLaw law{.exponent = n, .damping_exponent = n, .pull = Pull::kClamped};
      EXPECT_NEAR(DampingFor(law, e).value(), ExactCoefficient(e), 1e-6 * ExactCoefficient(e));
    }
  }
}

TEST(Impact, AQuarterPowerDamperThatMayPullIsThatOfAntypovAndElliott) {
  const ForceLaw law{.exponent = 1.5, .damping_exponent = 0.25};
  for (const double e : {0.95, 0.7, 0.3}) {
    EXPECT_NEAR(DampingFor(law, e).value(), TextbookDamping(law, e).value(), 1e-6);
  }
}

TEST(Impact, ASquareRootDamperGivesBackWhatIsKnownOfIt) {
  const ForceLaw pulls{.exponent = 1.5, .damping = 0.1, .damping_exponent = 0.5};
  ForceLaw pushes = pulls;
  pushes.pull = Pull::kClamped;
  EXPECT_NEAR(Collide(pulls, {}).velocity_ratio, 0.89214759, 1e-7);
  EXPECT_NEAR(Collide(pushes, {}).velocity_ratio, 0.89285888, 1e-7);
  EXPECT_NEAR(Collide(pushes, {}).duration, 3.157256, 1e-5);
}

TEST(Impact, UnderALoadVelocitiesObeyTheIdentity) {
  for (const double load : {0.1, 0.3}) {
    for (const Pull pull : {Pull::kAllowed, Pull::kClamped, Pull::kUndampedReturn}) {
      const Rebound r = Collide(Linear(pull, 0.1), {.load = load});
      const double e2 = r.restitution * r.restitution;
      EXPECT_NEAR(r.velocity_ratio * r.velocity_ratio, e2 - (1 - e2) * 2 * load * r.deformation,
                  1e-8);
    }
  }
}

TEST(Impact, UnderALargeLoadTheBodiesDoNotPart) {
  const Rebound rebound = Collide(Linear(Pull::kClamped, 0.5), {.load = 2});
  EXPECT_EQ(rebound.velocity_ratio, 0);
  EXPECT_TRUE(std::isnan(rebound.restitution));
}

TEST(Impact, ASolverThatCarriesTheLoadReboundsAsWithoutIt) {
  ForceLaw law = Linear(Pull::kClamped, 0.1);
  law.carries_load = true;
  const double loaded = Collide(law, {.load = 0.1}).velocity_ratio;
  EXPECT_GT(loaded, Collide(Linear(Pull::kClamped, 0.1), {.load = 0.1}).velocity_ratio + 0.01);
  EXPECT_NEAR(loaded, Collide(law, {}).velocity_ratio, 0.02);
}

TEST(Impact, ResultsScaleWithMassStiffnessAndVelocity) {
  const Collision collision{.mass = 3, .velocity = 0.2};
  const ForceLaw units{.exponent = 1.5, .damping = 0.4, .damping_exponent = 0.25};
  const Rebound big = Collide(WithStiffness(units, collision, 1e7), collision);
  const Rebound unit = Collide(units, {});
  const double length = std::pow(3 * 0.04 / 1e7, 0.4);
  EXPECT_NEAR(big.velocity_ratio, unit.velocity_ratio, 1e-10);
  EXPECT_NEAR(big.deformation, unit.deformation * length, 1e-9 * length);
  EXPECT_NEAR(big.duration, unit.duration * length / 0.2, 1e-8 * length);
}

TEST(Impact, AnOverdampedContactThatPullsDoesNotPart) {
  EXPECT_EQ(Delivered(Pull::kAllowed, 1.2), 0);
}

}  // namespace
}  // namespace contact::translate
