// Contacts whose force is a table with a way back of its own, (F1) to (F3).
#include "simulation/laws/force_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/proof/independent.h"
#include "simulation/statics/equilibrium.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

constexpr double kTableMass = 0.5;

void GiveTable(const ForceTable& table, Contact* contact) {
  contact->damping = DampingLaw::kForceTable;
  contact->table = table;
  contact->stiffness = table.At(1e-3, 0).value / 1e-3, contact->exponent = 1;
}

// A ball that meets a wall at once.
Scenario TableBlow(const ForceTable& table, double velocity, double end_time) {
  Scenario s;
  s.bodies = {{.name = "ball", .mass = kTableMass, .position = 0, .velocity = velocity}};
  s.contacts = {{.name = "wall", .left = 0}};
  GiveTable(table, &s.contacts[0]);
  s.end_time = end_time;
  return s;
}

TEST(ForceTable, IsTheDerivativeOfItsEnergy) {
  const std::vector<ForceTable::Point> points = {{1e-4, 5}, {3e-4, 40}, {1e-3, 60}};
  for (const ForceTable::Unloading back : {ForceTable::Unloading{}, {2e5, 0}, {2e5, 4e3}}) {
    const ForceTable table(points, back);
    for (const double yield : {0.0, 5e-4}) {
      for (const double d : {-1e-4, 5e-5, 2e-4, 2.6e-4, 4.5e-4, 7e-4, 2e-3}) {
        const double h = 1e-9;
        const double mean = (table.At(d + h, yield).value + table.At(d - h, yield).value) / 2;
        const double force = table.At(d, yield).value;
        EXPECT_NEAR(mean, force, 1e-9) << d;
        EXPECT_NEAR((table.At(d + h, yield).value - table.At(d - h, yield).value) / (2 * h),
                    table.At(d, yield).slope, 1e-3)
            << d;
        // On a way there that yields less is stored than is done.
        const double stored = (table.Energy(d + h, yield) - table.Energy(d - h, yield)) / (2 * h);
        if (!table.yields() || d < yield) {
          EXPECT_NEAR(stored, force, 1e-6) << d;
        } else {
          EXPECT_LT(stored, force) << d;
        }
        if (d >= yield || d <= 0) continue;
        const double change = table.At(d, yield + h).value - table.At(d, yield - h).value;
        EXPECT_NEAR(change / (2 * h), table.ByYield(d, yield), 1e-3) << d;
      }
    }
  }
}

TEST(ForceTable, IsInvertedByForceAndByEnergy) {
  const ForceTable table({{1e-4, 5}, {3e-4, 40}, {1e-3, 60}}, {});
  for (const double d : {5e-5, 1e-4, 2e-4, 9e-4, 5e-3}) {
    const double force = table.At(d, 0).value, energy = table.Energy(d, 0);
    EXPECT_NEAR(table.DepthUnder(force), d, 1e-15);
    EXPECT_NEAR(table.DepthOf(energy, 0), d, 1e-15);
    EXPECT_NEAR(table.DepthOf(energy - force * d / 3, force / 3), d, 1e-15);
  }
}

// One point is a straight line: with its slope back, too, the linear contact with ε = 1.
TEST(ForceTableContact, OfOnePointIsALinearContact) {
  const double k = 2e5, v = 0.7;
  for (const ForceTable::Unloading back : {ForceTable::Unloading{}, {k, 0}}) {
    const Record r = RunAndRecord(TableBlow(ForceTable({{1e-3, k * 1e-3}}, back), v, 0.02));
    ASSERT_EQ(r.cycles.size(), 1u);
    EXPECT_NEAR(r.cycles[0].end_time, std::numbers::pi * std::sqrt(kTableMass / k), 1e-13);
    EXPECT_NEAR(r.cycles[0].max_deformation, v * std::sqrt(kTableMass / k), 1e-13);
    EXPECT_NEAR(r.outcome.velocities[0], -v, 1e-10 * v);
  }
}

// Walton and Braun: ε = √(k₁/k₂) at every speed, a quarter of a period there and one back, and a
// flight out of what has yielded.
TEST(ForceTableContact, OfWaltonAndBraunHasTheirRestitutionAndTimes) {
  const double k1 = 2e5;
  for (const double e : {0.3, 0.6, 0.95}) {
    const double k2 = k1 / (e * e), w1 = std::sqrt(k1 / kTableMass),
                 w2 = std::sqrt(k2 / kTableMass);
    for (const double v : {1e-3, 0.5, 20.0}) {
      const Record r = RunAndRecord(TableBlow(ForceTable({{1e-3, k1 * 1e-3}}, {k2, 0}), v, 0.05));
      ASSERT_EQ(r.cycles.size(), 1u);
      const Cycle& cycle = r.cycles[0];
      EXPECT_NEAR(cycle.restitution_out, e, 1e-9 * e) << v;
      EXPECT_NEAR(-cycle.separation_velocity / v, e, 1e-9 * e) << v;
      EXPECT_NEAR(cycle.turn_time, std::numbers::pi / 2 / w1, 1e-9 / w1) << v;
      const double left = v / w1 * (1 - e * e);
      const double until = std::numbers::pi / 2 * (1 / w1 + 1 / w2) + left / (e * v);
      EXPECT_NEAR(cycle.end_time, until, 1e-9 * until) << v;
      EXPECT_NEAR(cycle.dissipated_compression, (1 - e * e) * cycle.work_compression,
                  1e-9 * cycle.work_compression);
      EXPECT_NEAR(cycle.dissipated_restitution, 0, 1e-9 * cycle.work_compression);
      EXPECT_LE(r.outcome.energy_residual, 1e-10);
      EXPECT_LE(r.outcome.momentum_residual, 1e-10);
      EXPECT_LE(cycle.identity_residual, 1e-9);
    }
  }
}

// k₂ = k₁ + S F_m: ε = 1/√(1 + S v/ω₀).
TEST(ForceTableContact, ThatStiffensBackHasLessRestitutionAtSpeed) {
  const double k = 2e5, stiffening = 3e3, w = std::sqrt(k / kTableMass);
  for (const double v : {1e-3, 0.1, 0.5, 5.0, 50.0}) {
    const Record r =
        RunAndRecord(TableBlow(ForceTable({{1e-3, k * 1e-3}}, {k, stiffening}), v, 0.1));
    ASSERT_EQ(r.cycles.size(), 1u);
    EXPECT_NEAR(r.cycles[0].restitution_out * std::sqrt(1 + stiffening * v / w), 1, 1e-9) << v;
  }
}

// Two slopes: a part of a sine, and a quarter of the faster one from where it goes on.
TEST(ForceTableContact, OfTwoSlopesTurnsWhereTwoSinesDo) {
  const double k1 = 1e5, k2 = 9e5, knee = 4e-4, v = 0.5;
  const double w1 = std::sqrt(k1 / kTableMass), w2 = std::sqrt(k2 / kTableMass);
  const double at = std::asin(w1 * knee / v) / w1;  // Where δ is at the knee.
  const double speed = std::sqrt(v * v - w1 * w1 * knee * knee);
  const double before = k1 * knee / k2;  // Of δ without the first slope.
  const double depth = std::hypot(before, speed / w2) - before;
  const double turn = at + std::atan2(speed / w2, before) / w2;
  const ForceTable table({{knee, k1 * knee}, {2 * knee, (k1 + k2) * knee}}, {});
  const Record r = RunAndRecord(TableBlow(table, v, 0.02));
  ASSERT_EQ(r.cycles.size(), 1u);
  EXPECT_NEAR(r.cycles[0].turn_time, turn, 1e-9 * turn);
  EXPECT_NEAR(r.cycles[0].max_deformation, knee + depth, 1e-9 * knee);
  EXPECT_NEAR(r.cycles[0].end_time, 2 * turn, 2e-9 * turn);
  EXPECT_NEAR(r.outcome.velocities[0], -v, 1e-9 * v);
}

// Under a load P the ball that has yielded falls back before it leaves, and swings on the way back
// without loss: half a sine about P/k₂ while F > 0, and a throw while F = 0.
TEST(ForceTableContact, SwingsOnTheWayBackWithoutLoss) {
  const double k1 = 2e5, k2 = 4 * k1, v = 0.5;
  Scenario s = TableBlow(ForceTable({{1e-3, k1 * 1e-3}}, {k2, 0}), v, 0.06);
  const double most = k1 * v * std::sqrt(kTableMass / k1), load = most / 5;
  s.loads = {{.body = 0, .constant = load}};
  const double peak = load + std::hypot(load, most);
  const double speed = std::sqrt(peak * (peak - 2 * load) / (k2 * kTableMass));
  const double w = std::sqrt(k2 / kTableMass);
  const double pressed = 2 * (std::numbers::pi - std::atan2(w * kTableMass * speed / load, 1)) / w;
  const double period = pressed + 2 * speed * kTableMass / load;
  const Record r = RunAndRecord(s);
  ASSERT_GE(r.cycles.size(), 4u);
  for (std::size_t i = 0; i + 1 < r.cycles.size(); ++i) {
    const Cycle& cycle = r.cycles[i];
    EXPECT_NEAR(cycle.peak_force, peak, 1e-8 * peak) << i;
    EXPECT_EQ(cycle.end, Cycle::End::kNonSeparation) << i;
    if (i == 0) continue;
    EXPECT_NEAR(cycle.restitution_out, 1, 1e-8) << i;
    EXPECT_NEAR(cycle.turn_time - r.cycles[i - 1].turn_time, period, 1e-8 * period) << i;
  }
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
}

// A blow after the first goes on where that ended on the way there, and yields further.
TEST(ForceTableContact, YieldsFurtherInTheSameEncounter) {
  const double k1 = 2e5, v = 0.5;
  Scenario s = TableBlow(ForceTable({{1e-3, k1 * 1e-3}}, {4 * k1, 0}), v, 0.03);
  s.loads = {{.body = 0, .constant = 40}, {.body = 0, .begin = 5e-3, .constant = 120}};
  const Record r = RunAndRecord(s);
  ASSERT_GE(r.cycles.size(), 2u);
  EXPECT_EQ(r.cycles[0].end, Cycle::End::kNonSeparation);
  double deepest = 0, largest = 0;
  for (std::size_t i = 0; i + 1 < r.cycles.size(); ++i) {
    deepest = std::max(deepest, r.cycles[i].max_deformation);
    largest = std::max(largest, r.cycles[i].peak_force);
  }
  EXPECT_GT(deepest, 1.1 * r.cycles[0].max_deformation);
  EXPECT_NEAR(largest, k1 * deepest, 1e-8 * largest);
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
}

// Beside contacts whose μ is sought, and each other.
TEST(ForceTableContact, AgreesWithAnIndependentIntegration) {
  Scenario s = testing::Chain({0.5, 0.5, 0.2, 0.5}, {1e8, 1e8, 1e8}, {0.8, 1, 0.7}, 0.2, 0.02);
  GiveTable(ForceTable({{1e-5, 10}, {1e-3, 3000}}, {6e6, 2e3}), &s.contacts[1]);
  s.contacts.push_back({.name = "wall", .left = 3, .wall_position = 0.3505});
  GiveTable(ForceTable({{2e-5, 30}, {5e-5, 100}, {2e-4, 2000}}, {2e7, 0}), &s.contacts[3]);
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_GE(r.cycles.size(), 5u);
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
  EXPECT_LE(r.outcome.momentum_residual, 1e-10);
  EXPECT_LE(r.outcome.worst_identity_residual, 1e-7);
  const testing::Disagreement d = testing::CompareWithIndependent(s, r);
  EXPECT_EQ(d.checked_until, s.end_time);
  EXPECT_LE(d.worst, 1e-8) << d.where;
}

TEST(ForceTableContact, IsStoodOnWhereItsForceIsTheWeight) {
  const ForceTable table({{1e-4, 5}, {3e-4, 40}}, {2e5, 0});
  for (const double weight : {2.0, 30.0, 90.0}) {
    Scenario s = TableBlow(table, 0, 0.1);
    s.loads = {{.body = 0, .constant = weight}};
    const Equilibrium found = FindEquilibrium(s);
    ASSERT_TRUE(found.unheld.empty());
    EXPECT_NEAR(found.positions[0], table.DepthUnder(weight), 1e-12);
    s.bodies[0].position = found.positions[0];
    s.starts_at_rest = true;
    const Record r = RunAndRecord(s);
    EXPECT_NEAR(r.outcome.positions[0], found.positions[0], 1e-12);
    EXPECT_LE(r.outcome.energy_residual, 1e-10);
  }
}

// What the corners of a table cost: the error control ends steps there.
TEST(ForceTableContact, OfManyPointsIsTheCurveTheyLieOn) {
  const double k = 1e8, v = 0.2;
  std::vector<ForceTable::Point> points;
  for (int i = 1; i <= 400; ++i) {
    const double d = 1e-6 * i;
    points.push_back({d, k * std::pow(d, 1.5)});
  }
  const Record r = RunAndRecord(TableBlow(ForceTable(points, {}), v, 0.01));
  const double hertz = MaximumDeformation(kTableMass, v, k, 1.5, 0);
  ASSERT_EQ(r.cycles.size(), 1u);
  EXPECT_NEAR(r.cycles[0].max_deformation, hertz, 1e-5 * hertz);
  EXPECT_NEAR(r.outcome.velocities[0], -v, 1e-9 * v);
  EXPECT_LE(r.outcome.steps, 20'000);
}

}  // namespace
}  // namespace contact
