#include "simulation/motion/motion.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "testing/cases.h"

namespace contact {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

// Gives every cycle the μ of its contact, and keeps what it hears.
class Host final : public CycleHost {
 public:
  explicit Host(std::vector<double> mu, bool sensitive = false)
      : mu_(std::move(mu)), sensitive_(sensitive) {}

  struct Ended {
    Cycle cycle;
    Eigen::ArrayXd compression_gradient, restitution_gradient;
  };
  std::vector<Cycle> started;
  std::vector<double> external_forces;
  std::vector<Ended> ended;
  int steps = 0;
  int most_steps = 1'000'000;

  Factor OnStart(ContactState& state, double /*mass*/, double external_force) override {
    started.push_back(state.cycle);
    external_forces.push_back(external_force);
    const auto contact = static_cast<std::size_t>(state.cycle.contact);
    return {.mu = mu_[contact], .column = sensitive_ ? columns_++ : kNone};
  }
  void OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
             const Eigen::ArrayXd& restitution_gradient, double /*length*/,
             double /*speed*/) override {
    ended.push_back({state.cycle, compression_gradient, restitution_gradient});
  }
  bool OnStep() override { return ++steps < most_steps; }

 private:
  const std::vector<double> mu_;
  const bool sensitive_;
  int columns_ = 0;
};

Motion::Pause Advance(Motion& motion, Host& host, double until = kEndless,
                      StepListener* listener = nullptr) {
  return motion.Advance(until, host, listener, {}, 1'000'000);
}

// The one cycle of a scenario whose contact begins to collide at once.
Cycle CycleWith(const Scenario& scenario, double mu, StepListener* listener = nullptr,
                double tolerance = 0) {
  Motion motion(scenario);
  motion.Begin(InitialState(scenario), true, tolerance);
  Host host({mu});
  EXPECT_EQ(Advance(motion, host, kEndless, listener), Motion::Pause::kQuiet);
  EXPECT_EQ(host.ended.size(), 1u);
  return host.ended.empty() ? Cycle{} : host.ended[0].cycle;
}

TEST(InitialState, WhatIsPressedStartsAndWhatTouchesAndApproaches) {
  for (const double gap : {-1e-4, 0.0, 1e-4}) {
    for (const double velocity : {-1.0, 0.0, 1.0}) {
      Scenario s = testing::Chain({1, 1}, {1e8}, {0.5}, velocity, 1);
      s.bodies[1].position += gap;
      const State state = InitialState(s);
      const bool starts = gap < 0 || (gap == 0 && velocity > 0);
      EXPECT_EQ(state.contacts[0].phase == Phase::kStarting, starts) << gap << ' ' << velocity;
      EXPECT_NEAR(state.contacts[0].gap, gap, 1e-16);
      EXPECT_EQ(InCycle(state), starts);
    }
  }
}

TEST(IsPacking, IsWhatMayKeepContactsClosed) {
  Scenario row = testing::TripleChain();
  EXPECT_FALSE(IsPacking(row));
  Scenario loaded = row;
  loaded.loads = {{.body = 0, .constant = 1}};
  EXPECT_TRUE(IsPacking(loaded));
  Scenario held = row;
  held.supports = {{.body = 0, .stiffness = 1}};
  EXPECT_TRUE(IsPacking(held));
  Scenario walled = row;  // As many contacts as bodies: walls.
  walled.contacts.push_back({.name = "wall", .right = 0, .wall_position = -1, .stiffness = 1});
  EXPECT_TRUE(IsPacking(walled));
}

TEST(Motion, AStepEndsOnTheTouch) {
  for (const double distance : {1e-7, 0.01, 12.0}) {
    Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 1);
    s.bodies[0].position -= distance;
    Motion motion(s);
    motion.Begin(InitialState(s), true);
    Host host({0});
    ASSERT_EQ(Advance(motion, host, 100), Motion::Pause::kCycleStarts);
    const State state = motion.Save();
    EXPECT_NEAR(state.time / (distance / 2), 1, 1e-9) << distance;
    EXPECT_NEAR(state.positions[0], -0.05, 1e-15 * (1 + distance));
    EXPECT_EQ(state.velocities[0], 2);
    EXPECT_EQ(state.contacts[0].phase, Phase::kStarting);
    EXPECT_EQ(state.contacts[0].cycle.kind, Cycle::Kind::kCollision);
    EXPECT_TRUE(host.started.empty());  // Its μ is asked for by the next Advance.
  }
}

TEST(Motion, TheErrorOfAStretchFollowsItsTolerance) {
  const Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 1);
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const Cycle c = CycleWith(s, 0, nullptr, tolerance);
    EXPECT_NEAR(c.separation_velocity / -2, 1, 100 * tolerance);
    EXPECT_NEAR(c.max_deformation / MaximumDeformation(0.3, 2, 5e7, 1.5, 0), 1, 100 * tolerance);
  }
}

TEST(Motion, AnElasticCycleIsSymmetricAboutItsTurn) {
  for (const double n : {1.0, 1.5, 2.5}) {
    const Cycle c = CycleWith(testing::Collision(0.3, 2, 5e7, n, 1), 0);
    EXPECT_NEAR((c.turn_time - c.start_time) / (c.end_time - c.turn_time), 1, 1e-8) << n;
    EXPECT_NEAR(c.work_compression, 0.5 * 0.3 * 2 * 2, 1e-9);
    EXPECT_NEAR(c.work_restitution, -c.work_compression, 1e-9);
    EXPECT_NEAR(c.peak_force / (5e7 * std::pow(c.max_deformation, n)), 1, 1e-7);
    EXPECT_EQ(c.tension_time, 0);
  }
}

// In phase with the exact oscillation, δ = 0 after half a period but for the error of the method.
TEST(Motion, FixedStepsThatEndOnEventsKeepTheOrderFour) {
  const double half_period = std::numbers::pi * std::sqrt(0.3 / 5e7);
  const auto error = [&](int steps) {
    Scenario s = testing::Collision(0.3, 2, 5e7, 1, 1);
    s.solver.fixed_step = half_period / (steps + 0.5);  // The last one is cut short.
    return std::abs(CycleWith(s, 0).end_time - half_period);
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4, 0.3);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 4, 0.3);
}

// Integrates F δ̇ over the steps of a contact, compression and restitution apart.
class Quadrature final : public StepListener {
 public:
  Quadrature(Motion& motion, const Contact& contact, double mu)
      : motion_(motion), contact_(contact), mu_(mu) {}

  double compression = 0, restitution = 0;

  void OnStep(const StepTime& step) override {
    motion_.PrepareInterpolation();
    const ContactState& state = motion_.contacts()[0];
    if (motion_.equations().active.empty()) return;
    const bool turned = state.phase == Phase::kRestitution;
    const double cut = turned ? std::clamp(step.Theta(state.cycle.turn_time), 0.0, 1.0) : 1;
    compression += Integrate(step, 0, cut);
    restitution += Integrate(step, cut, 1);
  }

 private:
  double Integrate(const StepTime& step, double from, double to) {
    const auto power = [&](double theta) {
      Eigen::ArrayXd y;
      motion_.Interpolate(theta, &y);
      const double deformation = std::max(0.0, motion_.Deformation(0, y.data()));
      const double rate = motion_.equations().Relative(0, y.data() + motion_.equations().bodies());
      const double elastic = std::pow(deformation, contact_.exponent);
      return elastic * (contact_.stiffness + mu_ * rate) * rate * step.h * step.Rate(theta);
    };
    return from == to ? 0 : boost::math::quadrature::gauss<double, 15>::integrate(power, from, to);
  }

  Motion& motion_;
  const Contact& contact_;
  const double mu_;
};

TEST(Motion, WorksOfACycleAreTheQuadratureOfItsForce) {
  for (const double n : {1.0, 1.5, 2.2}) {
    for (const double alpha : {0.0, 0.4, 3.0}) {
      Scenario s = testing::Collision(0.3, 2, 5e7, n, 0.8);
      s.loads = {{.body = 0, .constant = 3}};
      const double mu = alpha * 5e7 / 2;
      Motion motion(s);
      motion.Begin(InitialState(s), true);
      Host host({mu});
      Quadrature quadrature(motion, s.contacts[0], mu);
      ASSERT_EQ(Advance(motion, host, kEndless, &quadrature), Motion::Pause::kQuiet);
      const Cycle& c = host.ended.at(0).cycle;
      EXPECT_NEAR(quadrature.compression / c.work_compression, 1, 1e-8) << n << ' ' << alpha;
      EXPECT_NEAR(quadrature.restitution / c.work_restitution, 1, 1e-8) << n << ' ' << alpha;
      // Of a constant load the work is known, and with it all of compression, (W4).
      EXPECT_NEAR(c.external_compression / (3 * c.max_deformation), 1, 1e-9);
      EXPECT_NEAR(c.work_compression / (0.6 + 3 * c.max_deformation), 1, 1e-9);
    }
  }
}

// (S1), (S2): each gradient of a pass is the difference between passes with a little more and a
// little less of that μ, also of the μ of the other contact.
void ExpectGradientsAreDifferences(const Scenario& s, const std::vector<double>& mu) {
  const auto pass = [&](const std::vector<double>& with) {
    Motion motion(s);
    motion.Begin(InitialState(s), false);
    Host host(with, true);
    while (host.ended.size() < mu.size()) Advance(motion, host);
    return host.ended;
  };
  const auto ended = pass(mu);
  for (std::size_t j = 0; j < mu.size(); ++j) {
    std::vector<double> more = mu, less = mu;
    const double step = 1e-4 * mu[j];
    more[j] += step;
    less[j] -= step;
    const auto above = pass(more), below = pass(less);
    for (std::size_t i = 0; i < mu.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(j);
      const double compression =
          (above[i].cycle.work_compression - below[i].cycle.work_compression) / (2 * step);
      const double restitution =
          (above[i].cycle.work_restitution - below[i].cycle.work_restitution) / (2 * step);
      const double scale = ended[i].cycle.work_compression / mu[j];
      const auto of = [&](const Eigen::ArrayXd& gradient) {  // Of what is later there is none.
        return column < gradient.size() ? gradient[column] : 0;
      };
      EXPECT_NEAR(of(ended[i].compression_gradient), compression, 1e-5 * scale) << i << j;
      EXPECT_NEAR(of(ended[i].restitution_gradient), restitution, 1e-5 * scale) << i << j;
    }
  }
}

TEST(Motion, GradientsOfAPassAreDerivativesOfItsWorks) {
  ExpectGradientsAreDifferences(testing::TripleChain(), {2e8, 4e8});
}

// The first collision sends a ball off, and when it meets the next decides how fast that swings.
TEST(Motion, GradientsOutlastFlight) {
  Scenario s = testing::TripleChain();
  s.bodies[2].position += 2e-4;
  s.supports = {{.body = 2, .stiffness = 2e6, .rest_position = s.bodies[2].position + 2e-5}};
  ExpectGradientsAreDifferences(s, {2e8, 4e8});
}

// A body is pressed against a wall by F₀ + A sin ω t, where a damper c makes it creep. With
// c ω = k, λ is a million times ω: F = k δ + c δ̇, linear, has a closed form.
class Creep {
 public:
  static constexpr double kMass = 0.3, kStiffness = 5e7, kSpeed = 1e-5, kLoad = 1000, kSwing = 500;
  static constexpr double kDamping = 4e6, kOmega = kStiffness / kDamping;

  Creep() {
    const double mean = kDamping / (2 * kMass);
    fast_ = -mean - std::sqrt(mean * mean - kStiffness / kMass);
    slow_ = kStiffness / kMass / fast_;
    const double d = -kLoad / kStiffness - swing_.imag(), v = kSpeed - kOmega * swing_.real();
    of_fast_ = (v - slow_ * d) / (fast_ - slow_);
    of_slow_ = d - of_fast_;
  }

  Scenario scenario() const {
    Scenario s = testing::Collision(kMass, kSpeed, kStiffness, 1, 1);
    s.contacts[0].damping = DampingLaw::kKelvinVoigt;
    s.loads = {{.body = 0, .constant = kLoad, .amplitude = kSwing, .angular_frequency = kOmega}};
    return s;
  }
  double Deformation(double t) const {
    return kLoad / kStiffness + std::imag(swing_ * Turned(t)) + of_fast_ * std::exp(fast_ * t) +
           of_slow_ * std::exp(slow_ * t);
  }
  double Rate(double t) const {
    return kOmega * std::real(swing_ * Turned(t)) + fast_ * of_fast_ * std::exp(fast_ * t) +
           slow_ * of_slow_ * std::exp(slow_ * t);
  }
  double Force(double t) const { return kStiffness * Deformation(t) + kDamping * Rate(t); }
  // Of the first approach, which lasts some 1/λ, apart.
  double Work(double from, double to) const {
    const auto power = [&](double t) { return Force(t) * Rate(t); };
    const auto integral = [&](double a, double b) {
      return boost::math::quadrature::gauss<double, 30>::integrate(power, a, b);
    };
    const double calm = from == 0 ? -60 / fast_ : from;
    return integral(from, calm) + integral(calm, to);
  }
  // Where δ̇ changes its sign between two instants.
  double Turn(double a, double b) const {
    for (int i = 0; i < 100; ++i) {
      const double middle = (a + b) / 2;
      ((Rate(middle) > 0) == (Rate(a) > 0) ? a : b) = middle;
    }
    return a;
  }

 private:
  static std::complex<double> Turned(double t) { return std::polar(1.0, kOmega * t); }

  const std::complex<double> swing_ =
      kSwing / std::complex<double>(kStiffness - kMass * kOmega * kOmega, kDamping* kOmega);
  double fast_ = 0, slow_ = 0, of_fast_ = 0, of_slow_ = 0;
};

// Holds the dense output of every step against the closed form.
class CreepWatch final : public StepListener {
 public:
  CreepWatch(Motion& motion, const Creep& creep) : motion_(motion), creep_(creep) {}

  void OnStep(const StepTime& step) override {
    motion_.PrepareInterpolation();
    for (const double theta : {0.1, 0.5, 0.8}) {
      motion_.Interpolate(theta, &y_);
      const double t = step.At(theta);
      EXPECT_NEAR(y_[0], creep_.Deformation(t), 1e-10 * Creep::kLoad / Creep::kStiffness) << t;
      EXPECT_NEAR(y_[1], creep_.Rate(t), 1e-8 * Creep::kLoad / Creep::kDamping) << t;
    }
  }

 private:
  Motion& motion_;
  const Creep& creep_;
  Eigen::ArrayXd y_;
};

TEST(Motion, ACreepingContactIsFollowedInLongSteps) {
  const Creep creep;
  const Scenario s = creep.scenario();
  Motion motion(s);
  motion.Begin(InitialState(s), true);
  Host host({Creep::kDamping});
  CreepWatch watch(motion, creep);
  ASSERT_EQ(Advance(motion, host, kEndless, &watch), Motion::Pause::kQuiet);
  const Cycle& c = host.ended.at(0).cycle;
  const double period = 2 * std::numbers::pi / Creep::kOmega;
  const double turn = creep.Turn(0.1 * period, 0.7 * period);
  const double end = creep.Turn(turn + 0.1 * period, turn + 0.7 * period);
  EXPECT_NEAR(c.turn_time / turn, 1, 1e-7);
  EXPECT_NEAR(c.end_time / end, 1, 1e-7);
  EXPECT_NEAR(c.max_deformation / creep.Deformation(turn), 1, 1e-9);
  EXPECT_NEAR(c.end_deformation / creep.Deformation(end), 1, 1e-9);
  EXPECT_NEAR(c.work_compression / creep.Work(0, turn), 1, 1e-7);
  EXPECT_NEAR(c.work_restitution / creep.Work(turn, end), 1, 1e-7);
  EXPECT_LT(c.identity_residual, 1e-9);
  double peak = 0;
  for (double t = 0; t < turn; t += 1e-4 * turn) peak = std::max(peak, creep.Force(t));
  EXPECT_NEAR(c.peak_force / peak, 1, 1e-8);
  EXPECT_LT(motion.steps(), 2000);  // Explicit steps, of λ h ≤ 6, would be a million.
}

// (S1), (S2) along implicit steps.
TEST(Motion, GradientsFollowACreepingContact) {
  Scenario s = testing::Collision(0.3, 1e-3, 5e7, 1.5, 0.5);
  s.loads = {{.body = 0, .constant = 1000, .amplitude = 500, .angular_frequency = 300}};
  ExpectGradientsAreDifferences(s, {3e9});
}

// Energy and momentum of an undamped row at the end of every step.
class Balances final : public StepListener {
 public:
  explicit Balances(const Motion& motion) : motion_(motion) {}

  int steps = 0;

  void OnStep(const StepTime& /*step*/) override {
    ++steps;
    const double* y = motion_.integrator().y1.data();
    EXPECT_NEAR(motion_.equations().Energy(y) / (0.5 * 0.5 * 0.2 * 0.2), 1, 1e-9);
    EXPECT_NEAR(motion_.equations().Momentum(y) / (0.5 * 0.2), 1, 1e-13);
  }

 private:
  const Motion& motion_;
};

TEST(Motion, AnUndampedRowKeepsEnergyAndMomentumInEveryStep) {
  const Scenario s = testing::Chain({0.5, 0.4, 0.9, 0.2}, {1e8, 3e7, 2e8}, {1, 1, 1}, 0.2, 1);
  Motion motion(s);
  motion.Begin(InitialState(s), true);
  Host host({0, 0, 0});
  Balances balances(motion);
  EXPECT_EQ(Advance(motion, host, kEndless, &balances), Motion::Pause::kQuiet);
  EXPECT_GT(balances.steps, 20);
  EXPECT_GE(host.steps, balances.steps);  // It hears of those too that begin in an event.
}

TEST(Motion, AStateThatIsSavedInACycleGoesOn) {
  const Scenario s = testing::TripleChain();
  const std::vector<double> mu = {2e8, 4e8};
  Motion whole(s);
  whole.Begin(InitialState(s), true);
  Host all(mu);
  ASSERT_EQ(Advance(whole, all), Motion::Pause::kQuiet);
  Motion first(s), second(s);
  Host before(mu), after(mu);
  first.Begin(InitialState(s), true);
  ASSERT_EQ(Advance(first, before, 1e-3), Motion::Pause::kTimeUp);
  const State cut = first.Save();
  EXPECT_DOUBLE_EQ(cut.time, 1e-3);
  EXPECT_TRUE(InCycle(cut));
  second.Begin(cut, true);
  ASSERT_EQ(Advance(second, after), Motion::Pause::kQuiet);
  EXPECT_TRUE(after.started.empty());
  ASSERT_EQ(after.ended.size(), all.ended.size());
  for (std::size_t i = 0; i < all.ended.size(); ++i) {
    const Cycle &a = all.ended[i].cycle, &b = after.ended[i].cycle;
    EXPECT_NEAR(b.end_time / a.end_time, 1, 1e-9);
    EXPECT_NEAR(b.work_compression / a.work_compression, 1, 1e-9);
    EXPECT_NEAR(b.restitution_out / a.restitution_out, 1, 1e-8);
    EXPECT_LT(b.identity_residual, 1e-9);
  }
  EXPECT_NEAR(second.Save().contact_loss / whole.Save().contact_loss, 1, 1e-9);
}

TEST(Motion, ACycleThatStartsAtRestHearsOfItsExternalForce) {
  Scenario s = testing::Collision(0.3, 0, 5e7, 1.5, 0.5);
  s.loads = {{.body = 0, .constant = 700}};
  s.end_time = 1;
  Motion motion(s);
  motion.Begin(InitialState(s), true);
  Host host({1e6});
  ASSERT_EQ(Advance(motion, host), Motion::Pause::kCycleStarts);
  // Each cycle ends where the next one wants to start.
  for (int i = 0; i < 2; ++i) {
    motion.Begin(motion.Save(), true);
    ASSERT_EQ(Advance(motion, host, 1), Motion::Pause::kQuiet);
  }
  ASSERT_EQ(host.started.size(), 2u);
  EXPECT_EQ(host.started[0].kind, Cycle::Kind::kNirv);
  EXPECT_EQ(host.started[0].number, 1);
  EXPECT_NEAR(host.external_forces[0], 700, 1e-9);
  // Later cycles begin where the one before has ended, still compressed.
  EXPECT_EQ(host.started[1].number, 2);
  EXPECT_EQ(host.started[1].start_deformation, host.ended[0].cycle.end_deformation);
}

// In a step as short as what is left of δ of the first contact, that of the second is round-off.
TEST(Motion, ASeparationWithinRoundOffIsNow) {
  const Scenario s = testing::TripleChain();
  State state = InitialState(s);
  state.velocities = {-1, 0, 1e-2};
  for (ContactState& c : state.contacts) {
    c.phase = Phase::kRestitution;
    c.cycles = 1;
    c.duration = 1e-3;
    c.cycle.number = 1;
    c.cycle.mu = 1e6;
    c.cycle.max_deformation = 1e-4;
    c.cycle.work_compression = 0.25;
    c.cycle.approach_velocity = 1;
  }
  state.contacts[0].gap = -1e-20;
  state.contacts[1].gap = -1e-5;
  Motion motion(s);
  motion.Begin(state, true);
  Host host({1e6, 1e6});
  host.most_steps = 1000;
  ASSERT_EQ(Advance(motion, host), Motion::Pause::kQuiet);
  EXPECT_TRUE(host.started.empty());
  ASSERT_EQ(host.ended.size(), 2u);
  EXPECT_EQ(host.ended[0].cycle.contact, 0);
  EXPECT_EQ(host.ended[0].cycle.end, Cycle::End::kSeparation);
  EXPECT_LT(host.ended[0].cycle.end_time, 1e-12);
  EXPECT_GT(host.ended[1].cycle.end_time, 5e-4);  // δ/δ̇ is 1 ms.
}

TEST(Motion, SaysWhyItPauses) {
  const Scenario s = testing::TripleChain();
  const State start = InitialState(s);
  Motion motion(s);
  Host host({2e8, 4e8});
  std::stop_source stop;
  stop.request_stop();
  motion.Begin(start, true);
  EXPECT_EQ(motion.Advance(1, host, nullptr, stop.get_token(), 1000), Motion::Pause::kStopped);
  EXPECT_EQ(motion.time(), 0);
  motion.Begin(start, true);
  EXPECT_EQ(motion.Advance(1, host, nullptr, {}, motion.steps() + 3), Motion::Pause::kStepLimit);
  EXPECT_GE(motion.steps(), 3);
  motion.Begin(start, true);
  EXPECT_EQ(Advance(motion, host, 1e-5), Motion::Pause::kTimeUp);
  EXPECT_DOUBLE_EQ(motion.time(), 1e-5);
  host.most_steps = host.steps + 3;
  motion.Begin(start, true);
  EXPECT_EQ(Advance(motion, host), Motion::Pause::kEnough);
  Host broken({kNaN, kNaN});
  motion.Begin(start, true);
  EXPECT_EQ(Advance(motion, broken), Motion::Pause::kNumeric);
}

TEST(Motion, CountsGoOnFromWhereTheyWereRestored) {
  const Scenario s = testing::TripleChain();
  Motion motion(s);
  motion.Restore(1000, 20'000);
  motion.Begin(InitialState(s), true);
  const auto evaluations = motion.evaluations();
  Host host({2e8, 4e8});
  Advance(motion, host);
  const auto steps = motion.steps() - 1000;
  EXPECT_GT(steps, 20);
  // Eleven stages and the end of a step, at least the stages of a rejected one.
  EXPECT_GE(motion.evaluations() - evaluations, 11 * steps);
}

}  // namespace
}  // namespace contact
