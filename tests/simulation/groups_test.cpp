// Groups of cycles: one μ and one balance each, README.md, "Groups".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "simulation/kinds.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// Two balls and a wall: what no μ of the wall's first cycle alone can give.
Scenario TwoBallsAndAWall() {
  Scenario s;
  s.bodies = {testing::Ball(0, 1.535, 3.0433), testing::Ball(0.1, 0, 1.0897)};
  s.contacts = {{.name = "pair", .left = 0, .right = 1, .stiffness = 5744379, .restitution = 0.805},
                {.name = "wall",
                 .left = 1,
                 .wall_position = 0.15 + 0.0006,
                 .stiffness = 184680686.4,
                 .restitution = 0.678}};
  s.end_time = 0.02;
  return s;
}

// Works are those of its cycles, and give the restitution asked for.
void ExpectBalanced(const Record& r) {
  for (const Group& g : r.groups) {
    double compression = 0, restitution = 0;
    int cycles = 0;
    for (const Cycle& c : r.cycles) {
      if (c.contact != g.contact || c.group != g.number) continue;
      ++cycles;
      compression += c.work_compression;
      restitution += c.work_restitution;
      EXPECT_EQ(c.mu, g.mu);
      EXPECT_EQ(c.status, g.status);
    }
    EXPECT_EQ(cycles, g.cycles) << g.contact << " " << g.number;
    if (g.end == Cycle::End::kRunEnd) continue;
    EXPECT_NEAR(g.work_compression, compression, 1e-12 * compression);
    EXPECT_NEAR(g.work_restitution, restitution, 1e-12 * compression);
    if (g.status != Cycle::Status::kConverged) continue;
    EXPECT_NEAR(std::sqrt(-restitution / compression) / g.restitution_in, 1, 2e-8);
    EXPECT_LT(g.residual, 1e-8);
  }
}

TEST(Groups, TheWallOfTwoBallsNeedsTwoCycles) {
  const Record r = RunAndRecord(TwoBallsAndAWall());
  EXPECT_TRUE(r.outcome.all_converged);
  ExpectBalanced(r);
  const auto wall = std::ranges::find_if(
      r.groups, [](const Group& g) { return g.contact == 1 && g.cycles == 2; });
  ASSERT_NE(wall, r.groups.end());
  EXPECT_NEAR(wall->mu / 2.76e8, 1, 0.01);
  EXPECT_NE(wall->growth, Growth::kNotGrown);
}

// Each cycle that did not settle is in a group that is told once, the cut ones at the end included.
TEST(Groups, AreToldInOrderOfTheirNumbers) {
  Scenario s = TwoBallsAndAWall();
  s.end_time = 1.2e-3;
  for (const Scenario& scenario : {TwoBallsAndAWall(), s}) {
    const Record r = RunAndRecord(scenario);
    std::vector<int> number(scenario.contacts.size()), cycle(scenario.contacts.size());
    for (const Group& g : r.groups) {
      const auto contact = static_cast<std::size_t>(g.contact);
      EXPECT_EQ(g.number, ++number[contact]);
      EXPECT_GT(g.first_cycle, cycle[contact]);
      EXPECT_GT(g.end_time, g.start_time);
      cycle[contact] = g.first_cycle + g.cycles - 1;
    }
    for (const Cycle& c : r.cycles) {
      EXPECT_LE(c.group, number[static_cast<std::size_t>(c.contact)]);
      EXPECT_EQ(c.group == 0, c.status == Cycle::Status::kSettled);
    }
    EXPECT_EQ(r.outcome.growths, std::ssize(r.growths));
  }
}

TEST(Groups, OfOneCycleEachTheWallHasNoSolutionAndSaysWhatItReached) {
  Scenario s = TwoBallsAndAWall();
  s.solver.restitution_scope = RestitutionScope::kCycle;
  const Record r = RunAndRecord(s);
  EXPECT_FALSE(r.outcome.all_converged);
  const auto lost = std::ranges::find(r.groups, Cycle::Status::kInfeasible, &Group::status);
  ASSERT_NE(lost, r.groups.end());
  EXPECT_FALSE(std::isnan(lost->too_much.mu) && std::isnan(lost->too_little.mu));
}

TEST(Groups, OfAnEncounterHaveAllItsCycles) {
  Scenario s = TwoBallsAndAWall();
  s.solver.restitution_scope = RestitutionScope::kEncounter;
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  ExpectBalanced(r);
  for (const Group& g : r.groups) EXPECT_EQ(g.end == Cycle::End::kNonSeparation, false);
}

Record RunOfKind(testing::Kind kind, unsigned seed, RestitutionScope scope) {
  Scenario s = testing::Dice(seed, kind).Roll();
  s.solver.restitution_scope = scope;
  return RunAndRecord(s);
}

// A ball that a load holds to a wall: cycles of ever less work, until round-off makes them.
TEST(Groups, OfAnEncounterEndWhereItsCyclesBecomeNegligible) {
  for (const unsigned seed : {42u, 83u, 453u}) {
    const Record r = RunOfKind(testing::Kind::kBouncing, seed, RestitutionScope::kEncounter);
    EXPECT_EQ(r.outcome.end, Outcome::End::kFinished) << seed;
    EXPECT_TRUE(r.outcome.all_converged) << seed;
    EXPECT_LT(r.outcome.steps, 1'000'000) << seed;
    ExpectBalanced(r);
  }
}

TEST(Groups, AnEncounterThatOutlivesTheRunIsSeenToItsEnd) {
  EXPECT_TRUE(
      RunOfKind(testing::Kind::kSupport, 44, RestitutionScope::kEncounter).outcome.all_converged);
}

// The motion depends on the μ of a group also through the negligible cycles that keep it.
TEST(Groups, BeforeANegligibleCycleAreSolvedByTrueSlopes) {
  const Record r = RunOfKind(testing::Kind::kGaps, 436, RestitutionScope::kAuto);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_LT(r.outcome.iterations, 100);
}

// A row that Newton alone did not solve from its coarse passes.
TEST(Groups, ARowWithASmoothRootIsSolved) {
  Scenario s = testing::Chain({0.5543, 2.8435, 0.1788, 0.046}, {214289443, 1160451.1, 316036687},
                              {0.922, 0.864, 0.684}, 0.052, 0.02);
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  ExpectBalanced(r);
}

Scenario FromJson(const nlohmann::json& json) {
  Scenario s;
  const auto index = [&](const std::string& name) {
    const auto body = std::ranges::find(s.bodies, name, &Body::name);
    return static_cast<int>(body - s.bodies.begin());
  };
  for (const auto& b : json["bodies"]) {
    s.bodies.push_back(
        {b["name"], b["mass_kg"], b["radius_m"], b["position_m"], b["velocity_m_per_s"], false});
  }
  for (const auto& c : json["contacts"]) {
    Contact made;
    made.name = c["name"];
    made.stiffness = c["stiffness"];
    made.restitution = c["restitution"];
    const int first = index(c["between"][0]);
    made.left = first;
    if (c.contains("wall")) {
      made.wall_position = c["wall"]["position_m"];
      if (c["wall"]["side"] == "LEFT") std::swap(made.left, made.right);
    } else {
      made.right = index(c["between"][1]);
    }
    s.contacts.push_back(made);
  }
  for (const auto& q : json["supports"]) {
    s.supports.push_back({index(q["body"]), kNone, q["stiffness_n_per_m"], q["damping_n_s_per_m"],
                          q["rest_position_m"]});
  }
  for (const auto& l : json["loads"]) {
    Load load{.body = index(l["body"])};
    if (l.contains("constant")) load.constant = l["constant"]["force_n"];
    if (l.contains("sine")) {
      load.amplitude = l["sine"]["amplitude_n"];
      load.angular_frequency = l["sine"]["angular_frequency_rad_per_s"];
    }
    s.loads.push_back(load);
  }
  s.end_time = json["end_time_s"];
  return s;
}

// Judged by the balance: another order of growing may give other groups.
TEST(Groups, SolveTheReferenceScenarios) {
  std::ifstream in(std::string(CONTACT_SOURCE_DIR) + "/tests/reference/groups.json");
  const nlohmann::json all = nlohmann::json::parse(in);
  int same = 0;
  for (const auto& one : all) {
    SCOPED_TRACE(one["scenario"]["title"].get<std::string>());
    const Record r = RunAndRecord(FromJson(one["scenario"]));
    EXPECT_TRUE(r.outcome.all_converged);
    ExpectBalanced(r);
    double worst = 0;
    const std::vector<double> known = one["final_velocities_m_per_s"];
    for (std::size_t i = 0; i < known.size(); ++i) {
      worst = std::max(worst, std::abs(r.outcome.velocities[i] - known[i]));
    }
    same += worst < 1e-6;
  }
  EXPECT_GE(same, static_cast<int>(all.size()) / 2);
}

// Single collisions need no search: the first guess is the closed form.
TEST(Groups, SingleCollisionsHaveTheFactorOfTheClosedForm) {
  for (int i = 0; i < 400; ++i) {
    const double e = i < 390 ? 0.02 + 0.965 * i / 389 : 0.985 + 0.0145 * (i - 390) / 9;
    const double n = i % 2 == 0 ? 1.5 : 2, v = 0.1 * (1 + i % 7);
    Scenario s = testing::Collision(0.3, v, 5e7, n, e);
    if (i % 4 >= 2) {
      s = testing::Chain({0.3, 0.8}, {5e7}, {e}, v, 0.1);
      s.contacts[0].exponent = n;
    }
    const Record r = RunAndRecord(s);
    ASSERT_EQ(r.cycles.size(), 1U) << e;
    EXPECT_EQ(r.cycles[0].status, Cycle::Status::kConverged) << e << " " << n;
    EXPECT_LE(r.cycles[0].iterations, 3) << e;
    EXPECT_NEAR(r.cycles[0].mu / (ExactCoefficient(e) * 5e7 / v), 1, 1e-6) << e << " " << n;
  }
}

// A few of each kind; the campaign (tests/simulation/campaign.cpp) takes thousands.
TEST(Groups, RandomScenariosOfEveryKindHaveAnAnswer) {
  int full = 0, runs = 0, jumps = 0;
  for (int kind = 0; kind < testing::kSmallKinds; ++kind) {
    for (unsigned seed = 1000; seed < 1010; ++seed, ++runs) {
      SCOPED_TRACE(std::string(testing::kKindNames[kind]) + " " + std::to_string(seed));
      const Record r = RunAndRecord(testing::Dice(seed, testing::Kind(kind)).Roll());
      EXPECT_EQ(r.outcome.end, Outcome::End::kFinished);
      EXPECT_LT(r.outcome.energy_residual, 1e-8);
      ExpectBalanced(r);
      full += r.outcome.all_converged;
      jumps += std::ranges::any_of(r.groups,
                                   [](const Group& g) { return g.status == Cycle::Status::kJump; });
    }
  }
  EXPECT_GE(full, runs - runs / 10);  // README.md, "Known limits", has the share of thousands.
  EXPECT_LE(jumps, 2);
}

TEST(Groups, RandomEncountersOfEveryKindHaveAnAnswer) {
  int full = 0, runs = 0;
  for (int kind = 0; kind < testing::kSmallKinds; ++kind) {
    for (unsigned seed = 1000; seed < 1010; ++seed, ++runs) {
      SCOPED_TRACE(std::string(testing::kKindNames[kind]) + " " + std::to_string(seed));
      const Record r = RunOfKind(testing::Kind(kind), seed, RestitutionScope::kEncounter);
      EXPECT_EQ(r.outcome.end, Outcome::End::kFinished);
      ExpectBalanced(r);
      full += r.outcome.all_converged;
    }
  }
  EXPECT_GE(full, runs - 1);
}

}  // namespace
}  // namespace contact
