#include "simulation/motion/equations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "testing/cases.h"

namespace contact {
namespace {

// The shorter way for a few contacts gives the same slopes, to the last bit.
TEST(Equations, FewContactsAreComputedAsMany) {
  for (const bool recording : {false, true}) {
    for (const int contacts : {1, 2}) {
      const Scenario s = testing::TripleChain();
      Equations equations(s);
      for (int c = 0; c < contacts; ++c) {
        equations.active.push_back(equations.Activate(c, 1e-6, 2e8, c));
      }
      equations.recording = recording;
      Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(equations.size(), -1e-12, 3e-12);
      y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
      Eigen::ArrayXd many(y.size()), few(y.size());
      equations(0, y.data(), many.data(), 0.7);
      equations.Prepare();
      equations(0, y.data(), few.data(), 0.7);
      for (Eigen::Index i = 0; i < y.size(); ++i) EXPECT_EQ(few[i], many[i]) << i;
    }
  }
}

TEST(Equations, InternalForcesKeepTheMomentum) {
  Scenario s = testing::TripleChain();
  Equations equations(s);
  equations.active = {equations.Activate(0, 0, 1e8, kNone), equations.Activate(1, 0, 2e8, kNone)};
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(equations.size());
  y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
  equations(0, y.data(), dy.data());
  EXPECT_NEAR(dy.segment(3, 3).sum(), 0, 1e-12 * dy.segment(3, 3).abs().maxCoeff());
}

// F_e = m_e (F_i/m_i − F_j/m_j) with all other forces; here those of the second contact and a load.
TEST(Equations, ExternalForceIsThatOfTheOtherForces) {
  Scenario s = testing::Chain({0.5, 0.8, 0.3}, {1e8, 3e7}, {0.8, 0.7}, 0.2, 1);
  s.loads = {{.body = 0, .constant = 40}};
  Equations equations(s);
  equations.recording = true;
  equations.active = {equations.Activate(0, 0, 1e8, kNone), equations.Activate(1, 0, 2e8, kNone)};
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(equations.size());
  y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
  equations(0, y.data(), dy.data());
  const double other = Power(2e-5, 1.5).value * (3e7 + 2e8 * 0.05);
  const double effective = 1 / (1 / 0.5 + 1 / 0.8);
  const double external = effective * (40 / 0.5 + other / 0.8);
  EXPECT_NEAR(dy[equations.external_work(0)], external * 0.08, 1e-12 * external);
}

TEST(Equations, AWallHasInfiniteMass) {
  const Scenario s = testing::Mixed();
  EXPECT_DOUBLE_EQ(Equations(s).effective_mass(2), 0.5);
  EXPECT_DOUBLE_EQ(Equations(s).effective_mass(0), 1 / (1 / 0.5 + 1 / 0.8));
}

// F and its derivatives, of every kind of contact, against differences of F.
TEST(ActiveContact, DerivativesOfTheForceAreThoseOfItsDifferences) {
  for (const double n : {1.0, 1.2, 1.5, 3.0}) {
    for (const double p : {0.0, 0.25, 1.5, n}) {
      for (const double rate : {-0.3, 0.0, 0.4}) {
        ActiveContact c;
        c.stiffness = 1e8, c.exponent = n, c.damping_exponent = p, c.mu = 3e7;
        c.plain = n == 1.5 && p == 1.5;
        const double deformation = 2e-4, length = 1e-9, speed = 1e-6, factor = 1e2;
        const ActiveContact::Force f = c.At(deformation, rate);
        EXPECT_EQ(c.ForceAt(deformation, rate), f.force);
        const auto close = [&](double derivative, double more, double less, double step) {
          const double difference = (more - less) / (2 * step);
          EXPECT_NEAR(derivative, difference,
                      1e-5 * std::abs(difference) + 1e-15 * std::abs(f.force) / step)
              << n << ' ' << p;
        };
        close(f.by_deformation, c.At(deformation + length, rate).force,
              c.At(deformation - length, rate).force, length);
        close(f.by_rate, c.At(deformation, rate + speed).force,
              c.At(deformation, rate - speed).force, speed);
        ActiveContact more = c, less = c;
        more.mu += factor;
        less.mu -= factor;
        close(f.damping, more.At(deformation, rate).force, less.At(deformation, rate).force,
              factor);
      }
    }
  }
}

TEST(ActiveContact, PlainAndGeneralAgree) {
  ActiveContact c;
  c.stiffness = 1e8, c.mu = 3e7;
  for (const double deformation : {-1e-6, 0.0, 1e-7, 3e-4}) {
    for (const double rate : {-5.0, -0.1, 0.0, 2.0}) {
      const ActiveContact::Force plain = c.Plain(deformation, rate);
      const ActiveContact::Force general = c.General(deformation, rate);
      EXPECT_NEAR(plain.force, general.force, 1e-14 * std::abs(general.force));
      EXPECT_NEAR(plain.by_deformation, general.by_deformation,
                  1e-14 * std::abs(general.by_deformation));
      EXPECT_NEAR(plain.by_rate, general.by_rate, 1e-14 * std::abs(general.by_rate));
      EXPECT_NEAR(plain.damping, general.damping, 1e-14 * std::abs(general.damping));
    }
  }
}

TEST(ActiveContact, AClippedOneNeverPulls) {
  for (const double p : {0.0, 0.25, 1.5}) {
    ActiveContact c;
    c.stiffness = 1e8, c.damping_exponent = p, c.mu = 3e7, c.plain = p == 1.5;
    ActiveContact clipped = c;
    clipped.clipped = true;
    int pulls = 0;
    for (double rate = -10; rate < 10; rate += 0.37) {
      const double force = c.At(1e-4, rate).force;
      pulls += force < 0;
      EXPECT_EQ(clipped.Clips(1e-4, rate), force < 0) << p << ' ' << rate;
      EXPECT_NEAR(clipped.At(1e-4, rate).force, std::max(0.0, force), 1e-14 * std::abs(force));
      EXPECT_NEAR(clipped.ForceAt(1e-4, rate), std::max(0.0, force), 1e-14 * std::abs(force));
    }
    EXPECT_GT(pulls, 3);
  }
}

// Along the slope the energy changes by the work of the loads less all that is dissipated, and the
// momentum by the impulse: what the balances of a run rest on, (B1), (B2).
TEST(Equations, SlopesKeepTheBalances) {
  const Scenario scenario = testing::Mixed();
  Equations equations(scenario);
  equations.recording = true;
  for (int c = 0; c < 3; ++c) {
    equations.active.push_back(equations.Activate(c, 0, 1e7 * (c + 1), kNone));
  }
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(equations.size());
  y.head(6) << -3e-6, -2e-5, -9e-5, 0.1, -0.05, 0.02;
  equations(0.3, y.data(), dy.data());
  const double h = 1e-8;
  const Eigen::ArrayXd more = y + h * dy, less = y - h * dy;
  const double energy = (equations.Energy(more.data()) - equations.Energy(less.data())) / (2 * h);
  const double momentum =
      (equations.Momentum(more.data()) - equations.Momentum(less.data())) / (2 * h);
  double dissipated = dy[equations.support_loss()];
  for (const ActiveContact& c : equations.active) {
    const double rate = c.Relative(y.data() + 3);
    const double elastic =
        c.stiffness * Power(c.Relative(y.data()) - c.gap, c.exponent).value * rate;
    dissipated += dy[equations.work(c.contact)] - elastic;
  }
  EXPECT_GT(dissipated, 0);
  EXPECT_NEAR(energy, dy[equations.load_work()] - dissipated, 1e-6 * std::abs(energy));
  EXPECT_NEAR(momentum, dy[equations.impulse()], 1e-6 * std::abs(momentum));
}

// A clock of which a second is longer or shorter changes every slope by that, also of the
// quadratures.
TEST(Equations, SlopesAreInProportionToThePace) {
  const Scenario s = testing::Mixed();
  Equations equations(s);
  for (int c = 0; c < 3; ++c) equations.active.push_back(equations.Activate(c, 0, 1e7, kNone));
  for (const bool recording : {false, true}) {
    equations.recording = recording;
    Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), one(y.size()), half(y.size());
    y.head(6) << -3e-6, -2e-5, -9e-5, 0.1, -0.05, 0.02;
    equations(0.3, y.data(), one.data());
    equations(0.3, y.data(), half.data(), 0.5);
    for (Eigen::Index i = 0; i < one.size(); ++i) EXPECT_EQ(half[i], 0.5 * one[i]) << i;
  }
}

// Balls that only touch each other feel neither where they are nor how fast all of them move.
TEST(Equations, AccelerationsAreTheSameInEveryInertialFrame) {
  const Scenario s = testing::Chain({0.5, 0.8, 0.3, 0.6}, {1e8, 3e7, 5e7}, {1, 1, 1}, 0.2, 1);
  Equations equations(s);
  for (int c = 0; c < 3; ++c) equations.active.push_back(equations.Activate(c, 0, 1e7, kNone));
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(y.size()), moved(y.size());
  y.head(8) << 3e-5, 1e-5, -1e-5, -4e-5, 0.1, 0.02, -0.03, -0.2;
  equations(0, y.data(), dy.data());
  y.head(4) += 0.25;
  y.segment(4, 4) += 8;
  equations(0, y.data(), moved.data());
  EXPECT_GT(dy.segment(4, 4).abs().maxCoeff(), 1);
  for (Eigen::Index i = 4; i < 8; ++i) EXPECT_NEAR(moved[i] / dy[i], 1, 1e-8) << i;
}

TEST(Sides, PushWhatLiesBehindTheBodyTheyMove) {
  const Scenario s = testing::Mixed();  // 0: B1-B2, 1: B2-B3, 2: wall-B1.
  const Equations equations(s);
  EXPECT_TRUE(equations.sides(0).Pushes(equations.sides(1)));
  EXPECT_TRUE(equations.sides(1).Pushes(equations.sides(0)));
  EXPECT_TRUE(equations.sides(0).Pushes(equations.sides(2)));
  EXPECT_FALSE(equations.sides(1).Pushes(equations.sides(2)));  // They share no body.
  EXPECT_FALSE(equations.sides(0).Pushes(equations.sides(0)));
}

TEST(Power, IsZeroWithoutOverlapAndSmoothThere) {
  EXPECT_EQ(Power(-1e-3, 1.5).value, 0);
  EXPECT_EQ(Power(0, 1).value, 0);
  EXPECT_DOUBLE_EQ(Power(1e-4, 1.5).value, 1e-6);
  EXPECT_DOUBLE_EQ(Power(1e-4, 2).slope, 2e-4);
}

}  // namespace
}  // namespace contact
