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

TEST(ClusterCheckpoint, GoesOnAsIfItHadNeverStopped) {
  Scenario s = testing::Gas(40, 1e8, 1, 0.2);
  s.sample_interval = s.end_time / 200;
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
  }
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
