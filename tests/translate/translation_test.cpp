#include "translate/translation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "translate/damping.h"

namespace contact::translate {
namespace {

const Setup kSetup{.collision = {.mass = 0.4, .velocity = 0.7}, .radius = 0.02, .step = 1e-6};

const Tool& Named(std::string_view name) { return *FindTool(name); }

TEST(Translation, EveryToolGivesBackWhatIsAskedFor) {
  for (const Tool& tool : Tools()) {
    for (const double e : {0.95, 0.7, 0.5}) {
      const Translation found = Translate(tool, {.restitution = e, .stiffness = 1e5}, kSetup);
      ASSERT_EQ(found.values.size(), tool.parameters.size()) << tool.name << e;
      EXPECT_NEAR(found.alone.velocity_ratio, e, 1e-6) << tool.name;
    }
  }
}

TEST(Translation, ParametersAreReadAsTheyAreWritten) {
  for (const Tool& tool : Tools()) {
    const Translation there = Translate(tool, {.restitution = 0.6, .stiffness = 1e5}, kSetup);
    const Translation back = Judge(tool, there.values, kSetup);
    EXPECT_NEAR(back.law.stiffness / there.law.stiffness, 1, 1e-9) << tool.name;
    EXPECT_NEAR(back.law.damping / there.law.damping, 1, 1e-7) << tool.name;
    EXPECT_NEAR(back.alone.velocity_ratio, 0.6, 1e-6) << tool.name;
  }
}

TEST(Translation, EveryToolHasTheContactTimeThatIsAskedFor) {
  for (const Tool& tool : Tools()) {
    const Translation found = Translate(tool, {.restitution = 0.8, .duration = 3e-3}, kSetup);
    EXPECT_NEAR(found.alone.duration, 3e-3, 1e-9) << tool.name;
  }
}

TEST(Translation, ToolsOfOneExponentKeepTheStiffness) {
  const Wanted wanted{.restitution = 0.7, .stiffness = 2e4, .exponent = 1};
  EXPECT_EQ(Translate(Named("lammps-hooke"), wanted, kSetup).values[0], 2e4);
  EXPECT_EQ(Translate(Named("drake"), wanted, kSetup).values[0], 2e4);
  EXPECT_NEAR(Translate(Named("drake"), wanted, kSetup).values[1] * 0.7, 0.634828, 1e-6);
  const Translation hertz = Translate(Named("adams"), wanted, kSetup);
  EXPECT_NEAR(hertz.alone.duration, Translate(Named("drake"), wanted, kSetup).alone.duration, 1e-9);
}

TEST(Translation, TheSolrefOfMuJoCoDoesNotDependOnTheMass) {
  const Wanted wanted{.restitution = 0.5, .duration = 0.01};
  translate::Setup heavy = kSetup;
  heavy.collision.mass = 40;
  const auto a = Translate(Named("mujoco"), wanted, kSetup).values;
  const auto b = Translate(Named("mujoco"), wanted, heavy).values;
  EXPECT_NEAR(a[0] / b[0], 1, 1e-9);
  EXPECT_NEAR(a[1], 2 * 0.255276 * std::sqrt(a[0]), 2e-6 * a[1]);
}

TEST(Translation, ToolsThatTakeARestitutionDeliverItWhereTheirForceMayPull) {
  const Wanted wanted{.restitution = 0.6, .stiffness = 1e5};
  EXPECT_NEAR(Translate(Named("liggghts-hertz"), wanted, kSetup).values[1], 0.6, 1e-6);
  EXPECT_NEAR(Translate(Named("liggghts-hooke"), wanted, kSetup).values[1], 0.6, 1e-6);
  EXPECT_NEAR(Translate(Named("lammps-restitution"), wanted, kSetup).values[1], 0.6, 1e-6);
  const Translation limited = Translate(Named("liggghts-hooke-limited"), wanted, kSetup);
  EXPECT_LT(limited.values[1], 0.57);
  EXPECT_NEAR(limited.textbook.value(), 0.63229, 1e-5);
}

TEST(Translation, ARestitutionThatNoValueDeliversIsSaid) {
  const Translation found =
      Translate(Named("lammps-tsuji-limited"), {.restitution = 0.05, .stiffness = 1e5}, kSetup);
  EXPECT_TRUE(found.values.empty());
  ASSERT_EQ(found.warnings.size(), 1U);
}

TEST(Translation, WhatAToolLacksIsSaid) {
  translate::Setup bare = kSetup;
  bare.radius = 0;
  bare.step = 0;
  const Wanted wanted{.restitution = 0.5, .stiffness = 1e5};
  EXPECT_EQ(Translate(Named("simbody"), wanted, bare).missing, "radius");
  EXPECT_EQ(Translate(Named("ode"), wanted, bare).missing, "step");
}

TEST(Translation, AsStepsShrinkTheReboundBecomesThatOfTheLaw) {
  const ForceLaw law{.damping = 0.3, .pull = Pull::kClamped};
  const double exact = Collide(law, {}).velocity_ratio;
  for (const Stepping stepping : {Stepping::kSymplecticEuler, Stepping::kVerlet,
                                  Stepping::kImplicitEuler, Stepping::kSpeculative}) {
    double error = 1;
    for (const double step : {0.1, 0.01, 0.001}) {
      const SteppedRebound at = Step(law, {}, stepping, step);
      EXPECT_LE(at.least, at.mean);
      EXPECT_LE(at.mean, at.most);
      EXPECT_LT(std::abs(at.mean - exact), error / 3);
      error = std::abs(at.mean - exact);
    }
    EXPECT_LT(error, 1e-3);
  }
}

TEST(Translation, ABodyThatItsLoadHoldsComesBackInNoStep) {
  const ForceLaw law{.damping = 1, .pull = Pull::kClamped};
  for (const Stepping stepping : {Stepping::kSymplecticEuler, Stepping::kVerlet,
                                  Stepping::kImplicitEuler, Stepping::kSpeculative}) {
    EXPECT_EQ(Step(law, {.load = 20}, stepping, 0.01).most, 0);
  }
}

TEST(Translation, ToolsHaveDistinctNamesAndLinesWithTheirValues) {
  std::set<std::string_view> names;
  for (const Tool& tool : Tools()) {
    EXPECT_TRUE(names.insert(tool.name).second);
    const Translation found = Translate(tool, {.restitution = 0.7, .stiffness = 1e5}, kSetup);
    EXPECT_EQ(LineOf(tool, found.values).find('{'), std::string::npos);
  }
  EXPECT_EQ(FindTool("mujoko"), nullptr);
  EXPECT_EQ(ToolHint("mujoko"), "did you mean 'mujoco'?");
}

}  // namespace
}  // namespace contact::translate
