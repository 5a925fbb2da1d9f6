// What each damping law does in a collision, against its closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

constexpr double kPi = std::numbers::pi;

Scenario Impact(DampingLaw law, double restitution, double velocity = 2, double stiffness = 5e7) {
  const double n = law == DampingLaw::kKelvinVoigt ? 1 : 1.5;
  Scenario s = testing::Collision(0.3, velocity, stiffness, n, restitution);
  s.contacts[0].damping = law;
  return s;
}

Cycle OnlyCycle(const Scenario& s) {
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.cycles.size(), 1u) << r.outcome.message;
  if (r.cycles.size() != 1) return {};
  EXPECT_EQ(r.cycles[0].end, Cycle::End::kSeparation);
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
  EXPECT_LT(r.cycles[0].identity_residual, 1e-9);
  EXPECT_NEAR(-r.outcome.velocities[0] / s.bodies[0].velocity, r.cycles[0].restitution_out, 1e-9);
  return r.cycles[0];
}

TEST(Law, EveryHuntCrossleyTypeDeliversItsClosedForm) {
  for (const DampingLawRow& row : DampingLaws()) {
    if (row.scale != DampingScale::kVelocity) continue;
    for (const double e : {0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.99}) {
      const double delivered = row.Delivered(e);
      EXPECT_NEAR(OnlyCycle(Impact(row.law, e)).restitution_out, delivered, 1e-9)
          << row.name << " " << e;
    }
  }
}

// Below, at and above the critical damper, c = 2 √(k m), up to where it no longer pulls itself
// free.
TEST(Law, ADashpotIsTheDampedOscillatorOfItsNumbers) {
  for (const double ratio : {0.0, 0.1, 0.7, 0.99, 1.0, 3.0, 15.8}) {
    Scenario s = Impact(DampingLaw::kKelvinVoigt, 1);
    s.contacts[0].damping = DampingLaw::kDashpot;
    const double m = 0.3, k = 5e7, omega = std::sqrt(k / m);
    s.contacts[0].mu = 2 * ratio * std::sqrt(k * m);
    s.end_time = 2 / omega;
    const Record r = RunAndRecord(s);
    // δ = v (e^{r₁ t} − e^{r₂ t})/(r₁ − r₂), with r = (−ξ ± √(ξ² − 1)) ω.
    const std::complex<double> root = omega * std::sqrt(std::complex<double>(ratio * ratio - 1));
    const double decay = ratio * omega, t = s.end_time;
    const double deformation = 2 * std::exp(-decay * t) *
                               (std::abs(root) < 1e-6 ? t : (std::sinh(root * t) / root).real());
    EXPECT_NEAR(r.outcome.positions[0] + 0.05, deformation, 1e-9 * 2 / omega) << ratio;
    ASSERT_EQ(r.cycles.size(), 1u) << ratio;
    EXPECT_EQ(r.cycles[0].mu, s.contacts[0].mu);
    EXPECT_LT(r.outcome.energy_residual, 1e-9) << ratio;
  }
}

// δ = e^{−ξωt} sin(ω_d t) v/ω_d, from δ = 0 to δ = 0: half a period, and e^{−ξπ/√(1−ξ²)} = ε.
TEST(Law, KelvinVoigtDeliversItsRestitutionInHalfAPeriod) {
  for (const double e : {0.05, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const Cycle c = OnlyCycle(Impact(DampingLaw::kKelvinVoigt, e));
    const double ratio = -std::log(e) / std::hypot(kPi, std::log(e));
    const double omega = std::sqrt(5e7 / 0.3) * std::sqrt(1 - ratio * ratio);
    EXPECT_NEAR(std::exp(-ratio * kPi / std::sqrt(1 - ratio * ratio)), e, 1e-12);
    EXPECT_NEAR(c.restitution_out, e, 1e-9);
    EXPECT_NEAR((c.end_time - c.start_time) * omega / kPi, 1, 1e-9);
    EXPECT_GE(c.peak_force, c.mu * 2 * (1 - 1e-12));  // It begins with a jump to c δ̇⁻.
    EXPECT_GT(c.tension_time, 0);
    EXPECT_EQ(c.status, Cycle::Status::kGivenLaw);
  }
}

TEST(Law, HertzQuarterPowerDeliversItsRestitutionAtAnySpeedAndStiffness) {
  for (const double e : {0.05, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    for (const double v : {0.02, 3.0}) {
      for (const double k : {1e5, 1e10}) {
        const Cycle c = OnlyCycle(Impact(DampingLaw::kHertzQuarterPower, e, v, k));
        EXPECT_NEAR(c.restitution_out, e, 1e-8) << v << " " << k;
        EXPECT_GT(c.tension_time, 0);
      }
    }
  }
}

// Past the instant at which k δ + c δ̇ is 0 nothing acts on the ball any more.
TEST(Law, ClippedKelvinVoigtKeepsTheSpeedOfTheInstantWithoutForce) {
  for (const double e : {0.2, 0.5, 0.9}) {
    Scenario s = Impact(DampingLaw::kKelvinVoigt, e);
    s.solver.clip_tension = true;
    s.sample_interval = s.end_time / 1000;
    const double ratio = -std::log(e) / std::hypot(kPi, std::log(e));
    const double damped = std::sqrt(1 - ratio * ratio);
    const double phase = kPi - std::atan2(2 * ratio * damped, 1 - 2 * ratio * ratio);
    const double speed =
        std::exp(-ratio / damped * phase) * (ratio / damped * std::sin(phase) - std::cos(phase));
    const Record r = RunAndRecord(s);
    ASSERT_EQ(r.cycles.size(), 1u);
    EXPECT_NEAR(r.cycles[0].restitution_out, speed, 1e-8) << e;
    EXPECT_GT(r.cycles[0].restitution_out, e);
    EXPECT_GT(r.cycles[0].tension_time, 0);
    EXPECT_LT(r.outcome.energy_residual, 1e-9);
    for (int row = 0; row < r.rows(); ++row) EXPECT_GE(r.Sample(row, 5), 0);
  }
}

TEST(Law, ClippingChangesNothingWhereNothingPulls) {
  Scenario s = Impact(DampingLaw::kFlores, 0.3);
  const Cycle allowed = OnlyCycle(s);
  s.solver.clip_tension = true;
  const Cycle clipped = OnlyCycle(s);
  EXPECT_EQ(allowed.restitution_out, clipped.restitution_out);
  EXPECT_EQ(clipped.tension_time, 0);
}

// A load that pulls the ball off the wall: the contact of a large μ would pull back.
TEST(Law, ClippedCyclesAreSolvedForTheirRestitutionToo) {
  Scenario s = Impact(DampingLaw::kEnergyRestitution, 0.2, 0.05);
  s.loads = {{.body = 0, .constant = -500}};
  s.solver.restitution_tolerance = 1e-6;
  const Record allowed = RunAndRecord(s);
  s.solver.clip_tension = true;
  const Record clipped = RunAndRecord(s);
  ASSERT_FALSE(allowed.cycles.empty());
  ASSERT_FALSE(clipped.cycles.empty());
  EXPECT_GT(allowed.cycles[0].tension_time, 0);
  EXPECT_GT(clipped.cycles[0].tension_time, 0);
  EXPECT_EQ(clipped.cycles[0].status, Cycle::Status::kConverged);
  EXPECT_NEAR(clipped.cycles[0].restitution_out, 0.2, 2e-7);
  EXPECT_LT(clipped.outcome.energy_residual, 1e-9);
}

// Laws without δ̇⁻ have a μ in cycles that start at rest too, and say nothing of it.
TEST(Law, ThoseThatNeedNoVelocityKnowTheirFactorAtRest) {
  for (const DampingLaw law : {DampingLaw::kKelvinVoigt, DampingLaw::kHertzQuarterPower}) {
    Scenario s = Impact(law, 0.6);
    s.bodies[0].velocity = 0;
    s.loads = {{.body = 0, .constant = 700}};
    s.end_time = 0.002;
    const Record r = RunAndRecord(s);
    ASSERT_FALSE(r.cycles.empty());
    EXPECT_EQ(r.cycles[0].kind, Cycle::Kind::kNirv);
    EXPECT_DOUBLE_EQ(r.cycles[0].mu, DampingFactor(law, 0.6, 5e7, 0.3));
    for (const std::string& warning : r.warnings) {
      EXPECT_EQ(warning.find("approach"), std::string::npos) << warning;
    }
  }
}

// The sensitivities know that a force which begins with a jump begins at another instant.
TEST(Law, AJumpInAForceDoesNotSlowTheNewtonIteration) {
  Scenario s = testing::Chain({0.5, 0.4, 0.6}, {1e8, 2e5}, {0.6, 0.7}, 1, 0.05);
  s.bodies[2].position += 2e-5;
  s.contacts[1].exponent = 1;
  s.contacts[1].damping = DampingLaw::kKelvinVoigt;
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  for (const Cycle& c : r.cycles) EXPECT_LE(c.iterations, 5) << c.contact;
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
}

TEST(Law, SaysOnceThatItMissesByMoreThanAPercent) {
  const auto warnings = [](DampingLaw law, double e) {
    return RunAndRecord(Impact(law, e)).warnings;
  };
  EXPECT_TRUE(warnings(DampingLaw::kExact, 0.3).empty());
  EXPECT_TRUE(warnings(DampingLaw::kPaperEq23, 0.5).empty());  // 0.8 %
  ASSERT_EQ(warnings(DampingLaw::kHuntCrossley, 0.5).size(), 1u);
  EXPECT_NE(warnings(DampingLaw::kHuntCrossley, 0.5)[0].find("0.66296"), std::string::npos)
      << warnings(DampingLaw::kHuntCrossley, 0.5)[0];
}

}  // namespace
}  // namespace contact
