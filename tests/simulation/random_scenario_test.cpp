// Whatever comes out of a seeded dice: a run ends, nothing is NaN, balances close.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "testing/cases.h"

namespace contact {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double Log(double low, double high) { return std::exp(Uniform(std::log(low), std::log(high))); }
  int Below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  bool Chance(double p) { return Uniform(0, 1) < p; }

 private:
  std::mt19937 engine_;
};

Contact Law(Dice& dice) {
  Contact c;
  c.stiffness = dice.Log(1e5, 1e10);
  c.exponent = dice.Chance(0.7) ? 1.5 : dice.Uniform(1, 3);
  c.restitution = dice.Chance(0.1) ? 1 : dice.Uniform(0.1, 0.99);
  if (dice.Chance(0.3)) {
    const DampingLawRow& law = DampingLaws()[static_cast<std::size_t>(
        dice.Below(static_cast<int>(DampingLaw::kGiven) - 1))];
    c.damping = law.law;
    if (law.contact_exponent != 0) c.exponent = law.contact_exponent;
    if (dice.Chance(0.5)) c.reference_velocity = dice.Log(0.01, 10);
  }
  return c;
}

// A piece of a load that begins and ends in the run: of a step, a pulse or a table.
Load Piece(Dice& dice, int body, double end_time) {
  Load load{.body = body, .begin = dice.Chance(0.3) ? 0 : dice.Uniform(0, end_time)};
  if (dice.Chance(0.7)) load.end = load.begin + dice.Log(1e-6, 1e-2);
  if (dice.Chance(0.5)) {
    load.constant = dice.Uniform(-200, 200);
    if (dice.Chance(0.5) && std::isfinite(load.end)) {
      load.slope = dice.Uniform(-400, 400) / (load.end - load.begin);
    }
  } else {
    load.amplitude = dice.Uniform(-300, 300);
    load.angular_frequency = std::isfinite(load.end) ? 3.14159 / (load.end - load.begin) : 100;
  }
  return load;
}

Scenario Roll(Dice& dice) {
  Scenario s;
  const int n = 1 + dice.Below(8);
  double position = 0;
  for (int i = 0; i < n; ++i) {
    s.bodies.push_back(
        testing::Ball(position, dice.Chance(0.5) ? dice.Uniform(-2, 2) : 0, dice.Log(0.05, 5)));
    position += 0.1 + (dice.Chance(0.5) ? 0 : dice.Log(1e-6, 1e-2));
  }
  for (int i = 0; i + 1 < n; ++i) {
    s.contacts.push_back(Law(dice));
    s.contacts.back().left = i;
    s.contacts.back().right = i + 1;
  }
  const auto wall = [&](int left, int right, double at) {
    s.contacts.push_back(Law(dice));
    s.contacts.back().left = left;
    s.contacts.back().right = right;
    s.contacts.back().wall_position = at;
  };
  if (dice.Chance(0.5)) wall(kNone, 0, -0.05 - (dice.Chance(0.5) ? 0 : dice.Log(1e-6, 1e-2)));
  if (dice.Chance(0.5)) {
    wall(n - 1, kNone, s.bodies.back().position + 0.05 + dice.Log(1e-6, 1e-2));
  }
  for (std::size_t i = 0; i < s.contacts.size(); ++i) s.contacts[i].name = std::to_string(i);
  if (dice.Chance(0.4)) {
    const int body = dice.Below(n);
    s.supports.push_back({.body = body,
                          .other = n > 1 && dice.Chance(0.3) ? (body + 1) % n : kNone,
                          .stiffness = dice.Log(1e3, 1e6),
                          .damping = dice.Log(1, 100),
                          .rest_position = dice.Uniform(0, 0.1)});
  }
  if (dice.Chance(0.3)) {
    for (int i = 0; i < n; ++i) {
      s.loads.push_back(
          {.body = i, .constant = -9.81 * s.bodies[static_cast<std::size_t>(i)].mass});
    }
  }
  if (dice.Chance(0.4)) {
    s.loads.push_back({.body = dice.Below(n),
                       .constant = dice.Uniform(-100, 100),
                       .amplitude = dice.Uniform(0, 300),
                       .angular_frequency = dice.Log(1, 3000),
                       .phase = dice.Uniform(0, 6)});
  }
  s.end_time = dice.Log(1e-3, 0.02);
  while (dice.Chance(0.4)) s.loads.push_back(Piece(dice, dice.Below(n), s.end_time));
  s.solver.clip_tension = dice.Chance(0.15);
  s.sample_interval = s.end_time / 50;
  s.solver.max_steps = 4'000;
  return s;
}

void ExpectSound(const Scenario& s, const testing::Record& r) {
  const Outcome& o = r.outcome;
  EXPECT_TRUE(o.end == Outcome::End::kFinished || o.end == Outcome::End::kBudgetSteps) << o.message;
  for (const double x : o.positions) EXPECT_TRUE(std::isfinite(x));
  for (const double v : o.velocities) EXPECT_TRUE(std::isfinite(v));
  for (const double x : r.samples) EXPECT_TRUE(std::isfinite(x));
  for (const Cycle& c : r.cycles) {
    EXPECT_TRUE(std::isfinite(c.mu) && c.mu >= 0);
    EXPECT_GE(c.end_time, c.start_time);
    const bool cut = c.status == Cycle::Status::kCut || c.status == Cycle::Status::kUnfinished;
    EXPECT_TRUE(cut || (std::isfinite(c.work_compression) && std::isfinite(c.peak_force)));
    EXPECT_LE(c.iterations, s.solver.max_iterations);
  }
  for (const Group& g : r.groups) {
    if (g.status != Cycle::Status::kConverged || g.end == Cycle::End::kRunEnd) continue;
    if (g.restitution_in == 1) continue;
    EXPECT_NEAR(g.restitution_out / g.restitution_in, 1, s.solver.clip_tension ? 1e-5 : 2e-8)
        << "contact " << g.contact;
  }
  if (o.end != Outcome::End::kFinished) return;
  EXPECT_LT(o.energy_residual, 1e-7);
  EXPECT_LT(o.momentum_residual, 1e-7);
}

class RandomScenario : public ::testing::TestWithParam<int> {};

TEST_P(RandomScenario, EndsSoundly) {
  int finished = 0, cycles = 0, converged = 0;
  for (int i = 0; i < 10; ++i) {
    const unsigned seed = static_cast<unsigned>(1000 * GetParam() + i);
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const Scenario s = Roll(dice);
    const testing::Record r = testing::RunAndRecord(s);
    ExpectSound(s, r);
    finished += r.outcome.end == Outcome::End::kFinished;
    for (const Cycle& c : r.cycles) {
      ++cycles;
      converged += c.status != Cycle::Status::kNotConverged;
    }
  }
  RecordProperty("finished", finished);
  RecordProperty("cycles", cycles);
  RecordProperty("answered", converged);
  EXPECT_GE(finished, 1);  // The others spend their step budget; a few break down and say so.
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenario, ::testing::Range(0, 30));

}  // namespace
}  // namespace contact
