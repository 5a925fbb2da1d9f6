// Impacts that a swinging force or floor repeats, against the exact maps of rigid bodies: the
// stiffer the contact, the nearer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// The multiplier λ < 0 of a fixed point that leads a sequence to or from it, by its last four
// members: s_(n+2)/s_n = λ² (1 + O(s²)) for s_n = x_(n+1) − x_n.
double Multiplier(const std::vector<double>& x) {
  const std::size_t n = x.size();
  const double last = x[n - 1] - x[n - 2], before = x[n - 3] - x[n - 4];
  return -std::sqrt(last / before);
}

// Where a function that falls is −1, by secants from two arguments near it.
double WherePeriodDoubles(const std::function<double(double)>& multiplier, double a, double b) {
  double fa = multiplier(a) + 1, fb = multiplier(b) + 1;
  for (int i = 0; i < 6 && std::abs(b - a) > 1e-9 * std::abs(b); ++i) {
    const double c = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb;
    b = c, fb = multiplier(c) + 1;
  }
  return b;
}

// What a quantity tends to as contact times go to 0, by the values at three stiffnesses, each 16
// times the last: contact times are halved twice, and so is what is left of first order.
double Rigid(const std::vector<double>& values) {
  const double a = (4 * values[1] - values[0]) / 3, b = (4 * values[2] - values[1]) / 3;
  return (16 * b - a) / 15;
}

// A ball that leaves a table z = A sin ωt, Γ = A ω²/g, with what one bounce a period needs if the
// impact takes no time. Units: g = 1, m = 1, ω = 1, so A = Γ.
std::vector<double> BouncePhases(double gamma, double restitution, double stiffness, int bounces) {
  const double cosine = std::numbers::pi * (1 - restitution) / ((1 + restitution) * gamma);
  const double phase = std::acos(cosine);
  Scenario s;
  s.bodies = {{.name = "ball",
               .mass = 1,
               .position = gamma * std::sin(phase),
               .velocity = std::numbers::pi},
              {.name = "table",
               .position = gamma * std::sin(phase),
               .velocity = gamma * std::cos(phase),
               .fixed = true}};
  s.drives = {{.body = 1, .amplitude = gamma, .angular_frequency = 1, .phase = phase}};
  s.loads = {{.body = 0, .constant = -1}};
  s.contacts = {{.name = "C",
                 .left = 1,
                 .right = 0,
                 .stiffness = stiffness,
                 .exponent = 1,
                 .restitution = restitution}};
  s.end_time = 2 * std::numbers::pi * (bounces + 0.5);
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  std::vector<double> phases;
  for (const Cycle& c : r.cycles) {
    phases.push_back(c.start_time - 2 * std::numbers::pi * static_cast<double>(phases.size() + 1));
  }
  return phases;
}

// Γ² = (π(1 − e)/(1 + e))² + (2(1 + e²)/(1 + e)²)².
TEST(ShakingTable, DoublesItsPeriodWhereTheRigidMapDoes) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  for (const auto& [restitution, expected] : {std::pair(0.5, 1.526824), std::pair(0.8, 1.070836)}) {
    std::vector<double> found;
    for (const double stiffness : {1e6, 16e6, 256e6}) {
      const auto multiplier = [&, e = restitution](double gamma) {
        return Multiplier(BouncePhases(gamma, e, stiffness, 40));
      };
      found.push_back(WherePeriodDoubles(multiplier, 0.99 * expected, expected));
    }
    EXPECT_NEAR(Rigid(found), expected, 1e-4) << found[0] << " " << found[1] << " " << found[2];
  }
}

// The orbit of x″ + 2ζ x′ + x = cos(ωt + φ) below a stop at 0 that hits the stop once a period,
// at t = 0: φ, and the speed with which it leaves. Between impacts x = X(t) + e^(−ζt) (a cos w t +
// b sin w t) with X the steady swing; x(0) = x(T) = 0 and x′(T) = −x′(0)/e make X(0) and X′(0)
// multiples of the speed, and X(0)² + (X′(0)/ω)² is known.
struct Orbit {
  double phase, speed;
};
Orbit OrbitOf(double omega, double damping, double e) {
  const double w = std::sqrt(1 - damping * damping), period = 2 * std::numbers::pi / omega;
  const double sine = std::sin(w * period), cosine = std::cos(w * period);
  const double decay = std::exp(-damping * period);
  const double b = (cosine - 1 / decay) / sine;  // For X(0) = 1, so a = −1.
  const double start = b * w + damping;          // −x′(0) − X′(0)
  const double end = decay * (start * cosine + (w - damping * b) * sine);
  const double x = (1 + 1 / e) / (end - start);  // X(0) and X′(0) for a speed of 1.
  const double rate = -1 - start * x;
  const double stiff = 1 - omega * omega, viscous = 2 * damping * omega;
  const double swing = 1 / std::hypot(stiff, viscous);
  const double speed = swing / std::hypot(x, rate / omega);
  const double lag = std::atan2(viscous, stiff);  // X = swing cos(ωt + φ − lag)
  return {std::atan2(-rate / omega, x) + lag, speed};
}

std::vector<Cycle> StopImpacts(double omega, double damping, double e, double stiffness,
                               int periods) {
  const Orbit orbit = OrbitOf(omega, damping, e);
  Scenario s;
  s.bodies = {{.name = "mass", .mass = 1, .velocity = -orbit.speed}};
  s.supports = {{.body = 0, .stiffness = 1, .damping = 2 * damping}};
  s.loads = {{.body = 0,
              .amplitude = 1,
              .angular_frequency = omega,
              .phase = orbit.phase + std::numbers::pi / 2}};
  s.contacts = {
      {.name = "stop", .left = 0, .stiffness = stiffness, .exponent = 1, .restitution = e}};
  s.end_time = 2 * std::numbers::pi / omega * (periods + 0.5);
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged) << omega;
  return r.cycles;
}

TEST(ImpactOscillator, HitsTheStopAtTheSpeedsOfTheRigidMap) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  const double expected[] = {3.77495452, 5.19590262, 3.24479666, 1.84326664,
                             1.19800098, 0.85230175, 0.64253886};
  for (int i = 0; i < 7; ++i) {
    const double omega = 1.9 + 0.1 * i;
    std::vector<double> speeds;
    for (const double stiffness : {1e7, 16e7, 256e7}) {
      speeds.push_back(StopImpacts(omega, 0.02, 0.8, stiffness, 120).back().approach_velocity);
    }
    EXPECT_NEAR(Rigid(speeds) / expected[i], 1, 1e-4) << omega;
    EXPECT_NEAR(OrbitOf(omega, 0.02, 0.8).speed / 0.8 / expected[i], 1, 1e-8) << omega;
  }
}

TEST(ImpactOscillator, DoublesItsPeriodWhereTheRigidMapDoes) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  struct Known {
    double damping, e, omega;
  };
  for (const Known& known :
       {Known{0.02, 0.8, 2.655621}, Known{0.02, 0.7, 2.657892}, Known{0.05, 0.8, 2.658885}}) {
    std::vector<double> found;
    for (const double stiffness : {1e6, 16e6, 256e6}) {
      const auto multiplier = [&](double omega) {
        std::vector<double> phases;
        for (const Cycle& c : StopImpacts(omega, known.damping, known.e, stiffness, 24)) {
          phases.push_back(omega * c.start_time -
                           2 * std::numbers::pi * static_cast<double>(phases.size() + 1));
        }
        return Multiplier(phases);
      };
      found.push_back(WherePeriodDoubles(multiplier, known.omega - 0.004, known.omega));
    }
    EXPECT_NEAR(Rigid(found), known.omega, 1e-4) << found[0] << " " << found[1] << " " << found[2];
  }
}

}  // namespace
}  // namespace contact
