// Loads that begin, end and bend at instants: the integrator lands there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/methods/runge_kutta.h"
#include "simulation/motion/equations.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

Scenario OneBall(std::vector<Load> loads, double end_time) {
  Scenario s;
  s.bodies = {testing::Ball(0, 0.3)};
  s.loads = std::move(loads);
  s.end_time = end_time;
  return s;
}

Load HalfSine(double begin, double duration, double amplitude) {
  return {.begin = begin,
          .end = begin + duration,
          .amplitude = amplitude,
          .angular_frequency = std::numbers::pi / duration};
}

void ExpectGain(const Load& load, double impulse) {
  const Record r = RunAndRecord(OneBall({load}, 1));
  EXPECT_NEAR(0.5 * (r.outcome.velocities[0] - 0.3) / impulse, 1, 1e-12);
  EXPECT_LT(r.outcome.momentum_residual, 1e-12);
  EXPECT_LT(r.outcome.energy_residual, 1e-11);
}

TEST(Load, ImpulseOfAPulseIsTheMomentumGained) {
  ExpectGain({.begin = 0.1, .end = 0.1 + 0.2, .constant = 70}, 14);
  ExpectGain({.begin = 0.1, .end = 0.3, .constant = 20, .slope = 500}, 4 + 10);
  ExpectGain(HalfSine(0.1, 0.2, 70), 2 / std::numbers::pi * 14);
  ExpectGain({.begin = 0.7, .constant = -3}, -0.9);
}

TEST(Load, APulseShorterThanAnyStepIsNotMissed) {
  const double force = 1e6, duration = 1e-6;
  const Record r =
      RunAndRecord(OneBall({{.begin = 500, .end = 500 + duration, .constant = force}}, 1000));
  EXPECT_NEAR(r.outcome.velocities[0], 0.3 + (500 + duration - 500) * force / 0.5, 1e-12);
  EXPECT_LT(r.outcome.steps, 100);
}

TEST(Load, ActsFromItsBeginUpToItsEnd) {
  const Scenario s = OneBall({{.begin = 1, .end = 2, .constant = 5}}, 3);
  Equations equations(s);
  const double y[2] = {0, 0};
  double dy[2];
  const auto acceleration = [&](double selected_at, double t) {
    equations.SelectLoads(selected_at);
    equations(t, y, dy);
    return dy[1];
  };
  EXPECT_EQ(acceleration(0, 0.5), 0);
  EXPECT_EQ(acceleration(1, 1), 10);
  EXPECT_EQ(acceleration(2, 2), 0);
  // What is evaluated past a breakpoint goes on as the interval's formula does.
  EXPECT_EQ(acceleration(0, std::nextafter(1, 2)), 0);
  EXPECT_EQ(acceleration(1, std::nextafter(2, 3)), 10);
  EXPECT_EQ(equations.SelectLoads(0), 1);
  EXPECT_EQ(equations.SelectLoads(1), 2);
  EXPECT_EQ(equations.SelectLoads(2), std::numeric_limits<double>::infinity());
}

// A ball on a spring that a constant force pulls while it acts.
double Oscillator(double omega, double force_over_k, double begin, double end, double t) {
  const auto response = [&](double since) {
    return since > 0 ? force_over_k * (1 - std::cos(omega * since)) : 0;
  };
  return 0.3 / omega * std::sin(omega * t) + response(t - begin) - response(t - end);
}

TEST(Load, TheOrderOfConvergenceIsKeptAcrossABreakpoint) {
  Scenario s = OneBall({{.begin = 0.3, .end = 0.7, .constant = 40}}, 1);
  s.supports = {{.body = 0, .stiffness = 50}};
  const double exact = Oscillator(10, 40.0 / 50, 0.3, 0.7, 1);
  const auto error = [&](int steps) {
    Equations equations(s);
    RungeKutta rk;
    rk.Resize(equations.size(), equations.coupled());
    rk.y0 << 0, 0.3;
    double time = 0;
    while (time < 1) {
      const double end = std::min(equations.SelectLoads(time), 1.0);
      const double h = (end - time) / steps;
      for (int i = 0; i < steps; ++i) {
        equations(time + i * h, rk.y0.data(), rk.slope0.data());
        rk.Step(equations, {.start = time + i * h, .h = h});
        rk.y0.swap(rk.y1);
      }
      time = end;
    }
    return std::abs(rk.y0[0] - exact);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 8, 0.7);
  EXPECT_NEAR(std::log2(error(6) / error(12)), 8, 0.7);
}

TEST(Load, ARunKeepsItsToleranceAcrossBreakpoints) {
  Scenario s = OneBall({{.begin = 0.3, .end = 0.7, .constant = 40}}, 1);
  s.supports = {{.body = 0, .stiffness = 50}};
  const Record r = RunAndRecord(s);
  EXPECT_NEAR(r.outcome.positions[0], Oscillator(10, 40.0 / 50, 0.3, 0.7, 1), 1e-10);
  EXPECT_LT(r.outcome.energy_residual, 1e-11);
}

// A step load upon a ball that touches a wall: ε² = 1 − δ_o/δ_m, from the instant it begins.
TEST(Load, AStepLoadSatisfiesItsEnergyIdentityFromWhereItBegins) {
  for (const double e : {0.3, 0.6, 0.9}) {
    Scenario s;
    s.bodies = {testing::Ball(-0.05)};
    s.contacts = {{.name = "wall", .left = 0, .stiffness = 1e8, .restitution = e}};
    s.loads = {{.body = 0, .begin = 0.0123, .constant = 700}};
    s.end_time = 0.0183;
    const Record r = RunAndRecord(s);
    ASSERT_FALSE(r.cycles.empty()) << r.outcome.message;
    const Cycle& c = r.cycles[0];
    EXPECT_EQ(c.start_time, 0.0123);
    EXPECT_EQ(c.kind, Cycle::Kind::kNirv);
    EXPECT_NEAR(c.restitution_out, e, 1e-8);
    EXPECT_NEAR(1 - c.end_deformation / c.max_deformation, e * e, 1e-8);
  }
}

// Chains under pulses that begin and end inside cycles: every balance of the ledger still closes.
TEST(Load, PulsesInsideCyclesKeepTheLedger) {
  Scenario s = testing::TripleChain();
  s.loads = {{.body = 1, .begin = 4e-4, .end = 9e-4, .constant = 60},
             HalfSine(1.1e-3, 6e-4, -40),
             {.body = 2, .begin = 0, .end = 1e-3, .constant = 10, .slope = -3e4}};
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_GE(r.cycles.size(), 2u);
  EXPECT_LT(r.outcome.worst_identity_residual, 1e-9);
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
  EXPECT_LT(r.outcome.momentum_residual, 1e-9);
}

// e_N² = ε² − (1 − ε²) 2 P δ_m/(m v²), e_N the ratio of the speeds after and before: whatever ε,
// and however soft the contact.
TEST(Load, AConstantOneTakesOfTheSpeedWhatTheIdentitySays) {
  for (const double restitution : {0.5, 0.9}) {
    for (const double load : {0.5 * 9.81, 12.0, -20.0}) {
      Scenario s = testing::Collision(0.5, 1, 1e5, 1.5, restitution);
      s.loads = {{.body = 0, .constant = load}};
      const Record r = RunAndRecord(s);
      ASSERT_FALSE(r.cycles.empty());
      const Cycle& cycle = r.cycles.front();
      ASSERT_EQ(cycle.end, Cycle::End::kSeparation);
      const double v = cycle.approach_velocity, newton = -cycle.separation_velocity / v;
      const double mass = s.bodies[0].mass, e = cycle.restitution_out;
      EXPECT_NEAR(newton * newton,
                  e * e - (1 - e * e) * 2 * load * cycle.max_deformation / (mass * v * v), 1e-8)
          << restitution << " " << load;
      // So P is what the ledger tells: the work of F_e over the way.
      EXPECT_NEAR(cycle.external_compression / cycle.max_deformation, load, 1e-8);
      EXPECT_NEAR(cycle.external_restitution, -cycle.external_compression, 1e-10);
    }
  }
}

// Cutting a load in pieces changes nothing but round-off.
TEST(Load, PiecesOfALoadAreTheLoad) {
  Scenario s = testing::SpringWall();
  s.end_time = 0.01;
  const Record whole = RunAndRecord(s);
  s.loads[0].end = 0.0047;
  s.loads.push_back({.body = 0, .begin = 0.0047, .constant = 500});
  const Record pieces = RunAndRecord(s);
  ASSERT_EQ(pieces.cycles.size(), whole.cycles.size());
  EXPECT_NEAR(pieces.outcome.positions[0] / whole.outcome.positions[0], 1, 1e-8);
  EXPECT_NEAR(pieces.cycles.back().mu / whole.cycles.back().mu, 1, 1e-6);
}

}  // namespace
}  // namespace contact
