// What the dice roll is a scenario that the server would take.
#include "simulation/kinds/machines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "simulation/model/derived.h"

namespace contact::testing {
namespace {

// wire/ checks the same of what clients send.
void ExpectAllowed(const Scenario& s) {
  std::set<std::pair<int, int>> pairs;
  const auto fixed = [&](int i) { return s.bodies[static_cast<std::size_t>(i)].fixed; };
  for (const Body& b : s.bodies) {
    EXPECT_TRUE(b.mass > 0 && b.mass <= 1e12 && b.radius >= 0 && b.radius <= 1e6) << b.name;
  }
  std::vector<bool> driven(s.bodies.size());
  for (const Drive& d : s.drives) driven[static_cast<std::size_t>(d.body)] = true;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const Body& b = s.bodies[i];
    EXPECT_TRUE(!b.fixed || b.velocity == 0 || driven[i]) << b.name;
    EXPECT_TRUE(b.fixed || !driven[i]) << b.name;
  }
  for (const Contact& c : s.contacts) {
    EXPECT_TRUE(InitialGap(s, c) >= 0 || s.starts_at_rest) << c.name;
    EXPECT_TRUE(c.stiffness > 0 && c.stiffness <= 1e30) << c.name << ' ' << c.stiffness;
    EXPECT_TRUE(c.exponent >= 1 && c.exponent <= 5 && c.mu >= 0) << c.name;
    EXPECT_TRUE(c.restitution > 0 && c.restitution <= 1) << c.name;
    const double own = RowOf(c.damping).contact_exponent;
    EXPECT_TRUE(own == 0 || own == c.exponent) << c.name;
    EXPECT_FALSE((c.left == kNone || fixed(c.left)) && (c.right == kNone || fixed(c.right)));
    if (c.left == kNone || c.right == kNone || c.play > 0) continue;
    EXPECT_TRUE(pairs.insert(std::minmax(c.left, c.right)).second) << c.name;
  }
  for (const Support& p : s.supports) EXPECT_TRUE(p.stiffness <= 1e30 && !fixed(p.body));
  for (const Load& l : s.loads) {
    EXPECT_TRUE(l.begin >= 0 && l.end > l.begin && !fixed(l.body));
    EXPECT_TRUE(std::isfinite(l.constant) && std::isfinite(l.slope) && std::isfinite(l.amplitude));
  }
  EXPECT_TRUE(s.end_time > 0 && s.end_time <= 1e6) << s.end_time;
}

class EveryMachine : public ::testing::TestWithParam<Machine> {};

TEST_P(EveryMachine, RollsWhatTheContractAllows) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    ExpectAllowed(Roll(GetParam(), seed));
    if (HasFailure()) break;
  }
}

TEST_P(EveryMachine, RollsTheSameAgainAndOtherwiseForAnotherSeed) {
  const Scenario one = Roll(GetParam(), 7), again = Roll(GetParam(), 7);
  EXPECT_EQ(one.end_time, again.end_time);
  EXPECT_EQ(one.bodies.back().mass, again.bodies.back().mass);
  EXPECT_EQ(one.contacts.back().stiffness, again.contacts.back().stiffness);
  EXPECT_NE(one.contacts.back().stiffness, Roll(GetParam(), 8).contacts.back().stiffness);
}

INSTANTIATE_TEST_SUITE_P(Machines, EveryMachine, ::testing::ValuesIn(Machines()),
                         [](const auto& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace contact::testing
