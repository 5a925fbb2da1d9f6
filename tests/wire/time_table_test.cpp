// Tables of loads and motions: by points or by lists, once or again and again.
#include "wire/scenario/time_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "simulation/model/derived.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr char kBall[] = "bodies {name: 'B' mass_kg: 2 radius_m: 0.1} end_time_s: 1 ";

std::vector<std::string> Broken(const std::string& rest) {
  return Lines(DecodeScenario(FromText(kBall + rest)).violations);
}

std::vector<std::string> BrokenTable(const std::string& table) {
  return Broken("loads {body: 'B' table {" + table + "}}");
}

std::vector<Load> Pieces(const std::string& table, double end_time = 1) {
  v1::Scenario scenario = FromText(kBall + ("loads {body: 'B' table {" + table + "}}"));
  scenario.set_end_time_s(end_time);
  const DecodedScenario decoded = DecodeScenario(scenario);
  EXPECT_THAT(Lines(decoded.violations), IsEmpty());
  return decoded.scenario.loads;
}

double ForceAt(const std::vector<Load>& pieces, double t) {
  double force = 0;
  for (const Load& piece : pieces) {
    if (piece.begin <= t && t < piece.end) force += LoadForce(piece, t);
  }
  return force;
}

auto Numbers(const Load& piece) {
  return std::tuple(piece.body, piece.begin, piece.end, piece.constant, piece.slope);
}

auto Numbers(const Drive& piece) {
  return std::tuple(piece.begin, piece.end, piece.position, piece.velocity, piece.acceleration,
                    piece.jerk);
}

// What a scenario with these tables is, as numbers.
auto DrivesOf(const std::string& rest) {
  const DecodedScenario decoded =
      DecodeScenario(FromText(kBall + ("bodies {name: 'D' motion {" + rest + "}}")));
  EXPECT_THAT(Lines(decoded.violations), IsEmpty()) << rest;
  std::vector<decltype(Numbers(Drive()))> numbers;
  for (const Drive& piece : decoded.scenario.drives) numbers.push_back(Numbers(piece));
  return numbers;
}

TEST(TimeTable, ListsAreTheSameTableAsPoints) {
  const auto points = Pieces(
      "points {time_s: 0.1 force_n: 3} points {time_s: 0.25 force_n: -7} points {time_s: 0.9}");
  const auto lists = Pieces("times_s: [0.1, 0.25, 0.9] forces_n: [3, -7, 0]");
  ASSERT_EQ(points.size(), lists.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(Numbers(points[i]), Numbers(lists[i])) << i;
  }
  for (const auto& [kind, value, values] :
       {std::tuple("position_table", "position_m", "positions_m"),
        {"velocity_table", "velocity_m_per_s", "velocities_m_per_s"},
        {"acceleration_table", "acceleration_m_per_s2", "accelerations_m_per_s2"}}) {
    const std::string by_points = fmt::format(
        "{0} {{points {{time_s: 0.1 {1}: 3}} points {{time_s: 0.3 {1}: -7}} "
        "points {{time_s: 0.4 {1}: 5}}}}",
        kind, value);
    const std::string by_lists =
        fmt::format("{} {{times_s: [0.1, 0.3, 0.4] {}: [3, -7, 5]}}", kind, values);
    EXPECT_EQ(DrivesOf(by_points), DrivesOf(by_lists)) << kind;
  }
}

TEST(TimeTable, MillionRowsAreReadAndMoreAreNot) {
  v1::Scenario scenario = FromText(kBall);
  auto* load = scenario.add_loads();
  load->set_body("B");
  for (int i = 0; i < 1'000'000; ++i) {
    load->mutable_table()->add_times_s(i * 1e-6);
    load->mutable_table()->add_forces_n(i % 7);
  }
  EXPECT_THAT(DecodeScenario(scenario).scenario.loads, SizeIs(999'999));
  load->mutable_table()->add_times_s(2);
  EXPECT_THAT(Lines(DecodeScenario(scenario).violations),
              ElementsAre("loads[0].table.times_s: holds 1000001; must hold 2 to 1000000"));
}

TEST(TimeTable, WhatBreaksTheRulesOfListsIsToldAtItsPlace) {
  const std::string at = "loads[0].table.";
  EXPECT_THAT(BrokenTable(""),
              ElementsAre(at + "points: holds 0; must hold 2 to 10000 — times_s and forces_n are "
                               "lists for tables that are long"));
  EXPECT_THAT(BrokenTable("points {} points {time_s: 1} times_s: [0, 1] forces_n: [0, 1]"),
              ElementsAre(at + "points: is given beside times_s and forces_n — give the points or "
                               "the two lists"));
  EXPECT_THAT(BrokenTable("times_s: 1 forces_n: 1"),
              ElementsAre(at + "times_s: holds 1; must hold 2 to 1000000"));
  EXPECT_THAT(BrokenTable("forces_n: [1, 2]"),
              ElementsAre(at + "times_s: holds 0; must hold 2 to 1000000"));
  EXPECT_THAT(BrokenTable("times_s: [0, 1] forces_n: 1"),
              ElementsAre(at + "forces_n: holds 1; must hold 2, one for each of times_s"));
  EXPECT_THAT(BrokenTable("times_s: [-1, 2, 2] forces_n: [1, nan, 1e16]"),
              ElementsAre(at + "times_s[0]: is -1; must be in [0, 1e6]",
                          at + "times_s[2]: is 2, which is not after the 2 before — points follow "
                               "one another in time",
                          at + "forces_n[1]: is nan; must be in [-1e15, 1e15]",
                          at + "forces_n[2]: is 1e+16; must be in [-1e15, 1e15]"));
  EXPECT_THAT(Broken("bodies {name: 'D' motion {velocity_table {times_s: [0, 1] "
                     "velocities_m_per_s: [0, 2e6]}}}"),
              ElementsAre("bodies[1].motion.velocity_table.velocities_m_per_s[1]: is 2000000; must "
                          "be in [-1e6, 1e6]"));
}

TEST(PeriodicTable, IsItselfAPeriodLater) {
  const auto pieces = Pieces("times_s: [0.1, 0.15, 0.3] forces_n: [1, 4, 2] period_s: 0.25", 3);
  const auto once = Pieces("times_s: [0.1, 0.15, 0.3] forces_n: [1, 4, 2]");
  for (double t = 0; t < 3; t += 0.00123) {
    const double phase = t < 0.1 ? t : 0.1 + std::fmod(t - 0.1, 0.25);
    EXPECT_NEAR(ForceAt(pieces, t), ForceAt(once, phase), 1e-12) << t;
  }
  EXPECT_EQ(ForceAt(pieces, 0.09), 0) << "before its first point";
  EXPECT_EQ(ForceAt(pieces, 0.32), 0) << "between its last point and the next period";
}

TEST(PeriodicTable, JoinsWithoutGapOrOverlapWhereItFillsItsPeriod) {
  // 0.4 − 0.1 is more than 0.3 in binary.
  const auto pieces = Pieces("times_s: [0.1, 0.2, 0.4] forces_n: [1, 4, 2] period_s: 0.3", 99);
  EXPECT_THAT(pieces, SizeIs(2 * 330));
  for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_EQ(pieces[i - 1].end, pieces[i].begin);
}

TEST(PeriodicTable, IsRefusedWhereItHasNoPlaceOrTakesTooMuch) {
  const std::string two = "times_s: [0.1, 0.4] forces_n: [1, 2] period_s: ";
  EXPECT_THAT(BrokenTable(two + "0.2"),
              ElementsAre(HasSubstr("period_s: is 0.2; must be at least 0.3")));
  EXPECT_THAT(BrokenTable(two + "0"),
              ElementsAre("loads[0].table.period_s: is 0; must be in (0, 1e6]"));
  EXPECT_THAT(BrokenTable(two + "nan"), SizeIs(1));
  EXPECT_THAT(
      BrokenTable("times_s: [0, 1e-7] forces_n: [1, 2] period_s: 1e-7"),
      ElementsAre("loads[0].table.period_s: is 1e-07, with which all tables have 10000000 pieces "
                  "until end_time_s; must have at most 1000000 — give fewer points, an earlier "
                  "end_time_s, or a sine"));
}

}  // namespace
}  // namespace contact
