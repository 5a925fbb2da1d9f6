// A run in clusters goes on from the bytes of a checkpoint as if it had never stopped.
#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/run/run_state_codec.h"
#include "testing/cases.h"

namespace contact {
namespace {

struct Keeper : testing::Record {
  std::vector<std::string> checkpoints;
  std::vector<std::size_t> told;  // Cycles before each of them.
  void OnBoundary(const std::function<RunState()>& state) override {
    checkpoints.push_back(EncodeRunState(state()));
    told.push_back(cycles.size());
  }
};

void ExpectToGoOn(const Scenario& s) {
  Keeper whole;
  whole.outcome = contact::Run(s, whole);
  ASSERT_GT(whole.checkpoints.size(), 10U);
  for (std::size_t i = 0; i < whole.checkpoints.size(); i += whole.checkpoints.size() / 10) {
    const std::optional<RunState> state = DecodeRunState(whole.checkpoints[i]);
    ASSERT_TRUE(state.has_value());
    testing::Record rest;
    rest.outcome = contact::Resume(s, *state, rest);
    EXPECT_EQ(rest.outcome.velocities, whole.outcome.velocities);
    EXPECT_EQ(rest.outcome.steps, whole.outcome.steps);
    EXPECT_EQ(rest.outcome.iterations, whole.outcome.iterations);
    EXPECT_EQ(rest.outcome.energy_residual, whole.outcome.energy_residual);
    ASSERT_EQ(rest.cycles.size(), whole.cycles.size() - whole.told[i]);
    for (std::size_t c = 0; c < rest.cycles.size(); ++c) {
      EXPECT_EQ(rest.cycles[c].mu, whole.cycles[whole.told[i] + c].mu);
    }
    for (int column = 0; column < rest.columns; ++column) {
      EXPECT_EQ(rest.Sample(rest.rows() - 1, column), whole.Sample(whole.rows() - 1, column));
    }
  }
}

Scenario SampledGas() {
  Scenario s = testing::Gas(40, 1e8, 1, 0.2);
  s.sample_interval = s.end_time / 200;
  return s;
}

TEST(ClusterCheckpoint, GoesOnAsIfItHadNeverStopped) { ExpectToGoOn(SampledGas()); }

// On a table that swings, with a load that changes, and a ball on a spring.
TEST(ClusterCheckpoint, OfHeldBodiesGoesOnAsIfItHadNeverStopped) {
  Scenario s = SampledGas();
  s.end_time *= 2;
  s.drives.push_back({.body = 40, .amplitude = 1e-3, .angular_frequency = 300});
  s.bodies.push_back({.name = "table", .velocity = 0.3, .fixed = true});
  s.contacts[0].left = 40;
  s.loads.push_back({.body = 11, .amplitude = 2, .angular_frequency = 500});
  s.supports.push_back(
      {.body = 20, .stiffness = 1e3, .damping = 1, .rest_position = s.bodies[20].position});
  ExpectToGoOn(s);
}

// What a broken disk leaves of a checkpoint is refused, or read; nothing else happens.
TEST(ClusterCheckpoint, IsRefusedWhereItIsCutShort) {
  Keeper whole;
  contact::Run(testing::Gas(10, 1e8, 1, 0.2), whole);
  ASSERT_FALSE(whole.checkpoints.empty());
  const std::string& bytes = whole.checkpoints.back();
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 500) {
    EXPECT_FALSE(DecodeRunState(bytes.substr(0, length)).has_value()) << length;
  }
}

}  // namespace
}  // namespace contact
