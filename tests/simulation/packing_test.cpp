// Rows of balls pressed against a wall, whose contacts hardly ever open.
#include <gtest/gtest.h>

#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// Touching balls, the last of which touches a wall to the right.
Scenario RowAtWall(int balls, double restitution, double velocity, double end_time) {
  const auto n = static_cast<std::size_t>(balls);
  Scenario s = testing::Chain(std::vector<double>(n, 0.5), std::vector<double>(n - 1, 1e8),
                              std::vector<double>(n - 1, restitution), velocity, end_time);
  s.contacts.push_back({.name = "wall",
                        .left = balls - 1,
                        .wall_position = 0.1 * (balls - 1) + 0.05,
                        .stiffness = 1e8,
                        .restitution = restitution});
  return s;
}

// The same on end, let go under its own weight.
Scenario Column(int balls, double restitution, double end_time) {
  Scenario s = RowAtWall(balls, restitution, 0, end_time);
  for (int i = 0; i < balls; ++i) s.loads.push_back({.body = i, .constant = 0.5 * 9.81});
  return s;
}

TEST(Packing, ACycleThatRunsOnAfterAnEpisodeKeepsItsAnswer) {
  const Record r = RunAndRecord(Column(5, 0.7, 0.06));
  ASSERT_EQ(r.outcome.end, Outcome::End::kFinished);
  EXPECT_GT(r.outcome.episodes, 1);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_GE(r.cycles.size(), 20u);
  for (const Cycle& c : r.cycles) {
    EXPECT_EQ(c.status, Cycle::Status::kConverged) << c.contact << " " << c.number;
  }
}

}  // namespace
}  // namespace contact
