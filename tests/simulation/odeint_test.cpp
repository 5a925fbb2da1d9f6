// An independent method: Boost.odeint's Bulirsch-Stoer on the plain equations with the μ found.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/cases.h"

namespace contact {
namespace {

using Series = std::vector<double>;

// Touching balls in a row; F = k δ^1.5 + μ δ^1.5 δ̇ whenever δ > 0, works as states.
struct Balls {
  Series mass, stiffness, mu;
  std::size_t n() const { return mass.size(); }
  double Deformation(const Series& y, std::size_t c) const { return y[c] - y[c + 1]; }
  double Rate(const Series& y, std::size_t c) const { return y[n() + c] - y[n() + c + 1]; }

  void operator()(const Series& y, Series& dy, double) const {
    std::fill(dy.begin(), dy.end(), 0.0);
    for (std::size_t i = 0; i < n(); ++i) dy[i] = y[n() + i];
    for (std::size_t c = 0; c + 1 < n(); ++c) {
      const double deformation = std::max(0.0, Deformation(y, c)), rate = Rate(y, c);
      const double force = std::pow(deformation, 1.5) * (stiffness[c] + mu[c] * rate);
      dy[n() + c] -= force / mass[c];
      dy[n() + c + 1] += force / mass[c + 1];
      dy[2 * n() + c] = force * rate;  // Its integral to the turn is W_c, to the end W_c + W_r.
    }
  }
};

// From one of `times` to the next, so that no step straddles an event known to be there.
Series ByOdeint(const Balls& row, double velocity, const Series& times) {
  Series y(3 * row.n() - 1);
  y[row.n()] = velocity;
  double from = 0;
  for (const double to : times) {
    const auto stepper = boost::numeric::odeint::make_controlled(
        1e-15, 1e-13, boost::numeric::odeint::runge_kutta_fehlberg78<Series>());
    boost::numeric::odeint::integrate_adaptive(stepper, row, y, from, to, 1e-9);
    from = to;
  }
  return y;
}

TEST(Odeint, AgreesOnTheTripleChainWithTheFactorsFound) {
  const testing::Record r = testing::RunAndRecord(testing::TripleChain());
  const Cycle &first = r.cycles[0], &second = r.cycles[1];
  const Balls row{{0.5, 0.5, 0.5}, {1e8, 1e8}, {first.mu, second.mu}};
  const Series turn1 = ByOdeint(row, 0.2, {first.turn_time});
  const Series turn2 = ByOdeint(row, 0.2, {second.turn_time});
  const Series end = ByOdeint(row, 0.2, {first.end_time, second.end_time, 4e-3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(end[3 + i], r.outcome.velocities[i], 2e-9);
    EXPECT_NEAR(end[i], r.outcome.positions[i] - 0.1 * static_cast<double>(i), 5e-12);
  }
  EXPECT_NEAR(std::sqrt(1 - end[6] / turn1[6]), 0.8, 1e-8);
  EXPECT_NEAR(std::sqrt(1 - end[7] / turn2[7]), 0.7, 1e-8);
}

// The last case of chains.json, with the reference's own μ: balls 1 and 2 meet again after they
// have parted, which an integration that forgets nothing shows and the reference left out.
TEST(Odeint, BallsOfTheLastReferenceChainMeetAgain) {
  std::ifstream in(std::string(CONTACT_SOURCE_DIR) + "/tests/reference/chains.json");
  const nlohmann::json chain = nlohmann::json::parse(in).back();
  const Balls row{chain["masses"], chain["k"], chain["mu"]};
  const double parted = chain["t_end"][0].get<double>();
  const double velocity = chain["v"][0].get<double>();
  EXPECT_LT(row.Deformation(ByOdeint(row, velocity, {parted * 1.02}), 0), 0);
  double deepest = -1;
  for (double t = parted * 1.02; t < 3e-3; t += 2e-5) {
    deepest = std::max(deepest, row.Deformation(ByOdeint(row, velocity, {t}), 0));
  }
  EXPECT_GT(deepest, 1e-7);
}

}  // namespace
}  // namespace contact
