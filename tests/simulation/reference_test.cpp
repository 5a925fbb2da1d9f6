// Solved cases: tests/reference/README.md says where each comes from.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

nlohmann::json Reference(const std::string& file) {
  std::ifstream in(std::string(CONTACT_SOURCE_DIR) + "/tests/reference/" + file);
  return nlohmann::json::parse(in);
}

void ExpectBalances(const Record& r) {
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished) << r.outcome.message;
  EXPECT_LT(r.outcome.worst_identity_residual, 1e-9);
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
  EXPECT_LT(r.outcome.momentum_residual, 1e-13);
}

TEST(Reference, TripleChain) {
  Scenario s = testing::TripleChain();
  s.solver.restitution_tolerance = 1e-10;
  const Record r = RunAndRecord(s);
  ExpectBalances(r);
  ASSERT_EQ(r.cycles.size(), 2u);
  EXPECT_NEAR(r.cycles[0].mu / 2.259378079e8, 1, 1e-9);
  EXPECT_NEAR(r.cycles[1].mu / 4.563828953e8, 1, 1e-9);
  EXPECT_EQ(r.cycles[0].kind, Cycle::Kind::kCollision);
  EXPECT_EQ(r.cycles[1].kind, Cycle::Kind::kNirv);
  EXPECT_NEAR(r.cycles[0].end_time, 2.154799718e-3, 1e-12);
  EXPECT_NEAR(r.cycles[1].end_time, 2.576052458e-3, 1e-12);
  const double velocities[] = {-0.003731206344, 0.048726255138, 0.155004951207};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(r.outcome.velocities[i], velocities[i], 1e-11);
}

// At the looser of the two tolerances that users are told of.
TEST(Reference, TripleChainAtTolerance1e9) {
  Scenario s = testing::TripleChain();
  s.solver.relative_tolerance = 1e-9;
  s.solver.restitution_tolerance = 1e-9;
  const Record r = RunAndRecord(s);
  EXPECT_NEAR(r.cycles[0].mu / 2.259378079e8, 1, 1e-7);
  EXPECT_NEAR(r.cycles[1].mu / 4.563828953e8, 1, 1e-7);
  const double velocities[] = {-0.003731206344, 0.048726255138, 0.155004951207};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(r.outcome.velocities[i], velocities[i], 1e-9);
}

TEST(Reference, Chains) {
  for (const nlohmann::json& chain : Reference("chains.json")) {
    const std::vector<double> mu = chain["mu"];
    const std::vector<double> masses = chain["masses"], velocities = chain["v"];
    Scenario s = testing::Chain(masses, chain["k"], chain["eps"], velocities[0], 0.03);
    s.solver.restitution_tolerance = 1e-10;
    SCOPED_TRACE(chain["masses"].dump());
    const Record r = RunAndRecord(s);
    ExpectBalances(r);
    EXPECT_TRUE(r.outcome.all_converged);
    // In the last case balls 1 and 2 meet again. The reference let them pass through each other
    // then; the second meeting shifts all μ of the episode, by 3e-5 at the most. See odeint_test.
    const bool meets_again = r.cycles.size() > mu.size();
    EXPECT_EQ(meets_again, masses[0] == 0.957);
    for (const Cycle& cycle : r.cycles) {
      if (cycle.number > 1) continue;
      EXPECT_NEAR(cycle.mu / mu[static_cast<std::size_t>(cycle.contact)], 1,
                  meets_again ? 4e-5 : 1e-8)
          << cycle.contact;
    }
    if (meets_again) continue;
    const std::vector<double> final = chain["v_final"];
    for (std::size_t i = 0; i < final.size(); ++i) {
      EXPECT_NEAR(r.outcome.velocities[i], final[i], 1e-9);
    }
  }
}

TEST(Reference, SpringWall) {
  const Record r = RunAndRecord(testing::SpringWall());
  ExpectBalances(r);
  const nlohmann::json reference = Reference("spring_ball.json");
  ASSERT_GE(r.cycles.size(), reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const nlohmann::json& expected = reference[i];
    const Cycle& cycle = r.cycles[i];
    SCOPED_TRACE(i + 1);
    EXPECT_EQ(cycle.kind == Cycle::Kind::kCollision, expected["kind"] == "collision");
    EXPECT_EQ(cycle.end == Cycle::End::kSeparation, expected["end"] == "separation");
    EXPECT_EQ(cycle.status, Cycle::Status::kConverged);
    // The reference starts each cycle up to 1e-9 s late, hence velocities to 1e-5 (13.5 m/s and
    // 1e4 m/s²); its μ/k and deformations stand to 1e-6.
    EXPECT_NEAR(cycle.mu / 1.8e7, expected["mu_over_k"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.max_deformation, expected["delta_max"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.start_deformation, expected["delta_start"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.end_deformation, expected["delta_end"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.start_time, expected["t_start"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.end_time, expected["t_end"].get<double>(), 1e-6);
    EXPECT_NEAR(cycle.approach_velocity, expected["v_start"].get<double>(), 2e-5);
    EXPECT_NEAR(cycle.separation_velocity, expected["v_end"].get<double>(), 2e-5);
  }
}

// The free flight before the first touch is a linear oscillator under a sine: closed form.
TEST(Reference, SpringWallFirstTouchIsThatOfTheClosedForm) {
  const Record r = RunAndRecord(testing::SpringWall());
  EXPECT_NEAR(r.cycles[0].start_time / 0.0009677590533604675, 1, 1e-11);
  EXPECT_NEAR(r.cycles[0].approach_velocity / 13.488301377886005, 1, 1e-10);
}

TEST(Reference, EqualRestitutionsOfTable3) {
  for (const nlohmann::json& row : Reference("table3.json")) {
    const double e = row["eps"];
    Scenario chain = testing::Chain({0.5, 0.5, 0.5}, {1e8, 1e8}, {e, e}, 0.2, 5e-3);
    chain.solver.restitution_tolerance = 1e-10;
    const Record r = RunAndRecord(chain);
    ExpectBalances(r);
    EXPECT_NEAR(r.cycles[0].mu * 0.2 / 1e8, row["alpha12"].get<double>(), 1e-8) << e;
    EXPECT_NEAR(r.cycles[1].mu * 0.2 / 1e8, row["alpha23"].get<double>(), 1e-8) << e;
    const std::vector<double> velocities = row["v_over_v0"];
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(r.outcome.velocities[i] / 0.2, velocities[i], 1e-8);
    }
  }
}

TEST(Reference, EveryCellOfTable3ConvergesInAtMostSixCorrections) {
  for (const double velocity : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    for (int percent = 95; percent >= 10; percent -= 5) {
      const double e = percent / 100.0;
      const Record r = RunAndRecord(
          testing::Chain({0.5, 0.5, 0.5}, {1e8, 1e8}, {e, e}, velocity, 1e-3 / velocity));
      EXPECT_TRUE(r.outcome.all_converged) << e;
      EXPECT_LE(r.outcome.iterations, 6) << e << " " << velocity;
    }
  }
}

}  // namespace
}  // namespace contact
