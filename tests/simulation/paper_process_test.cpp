// The paper's own process (its Fig. 7) against the numbers that it published.
#include <gmock/gmock.h>

#include <vector>

#include "testing/cases.h"

namespace contact {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using testing::Record;
using testing::RunAndRecord;
using ::testing::SizeIs;

constexpr double kStep = 1e-6;  // The paper's [s].

Scenario AsPaper(Scenario scenario, UpdateRule update, double tolerance) {
  scenario.solver.fixed_step = kStep;
  scenario.solver.update = update;
  scenario.solver.restitution_tolerance = tolerance;
  return scenario;
}

// Table 2, with the phases split at the largest force as there.
Scenario Table2(UpdateRule update = UpdateRule::kPaperRatio) {
  Scenario scenario = AsPaper(testing::TripleChain(), update, 0.01);
  scenario.solver.phase_split = PhaseSplit::kPeakForce;
  for (Contact& c : scenario.contacts) c.reference_velocity = 0.2;
  return scenario;
}

// The table's rows of other models give both contacts the factor for 0.8.
Record Table2Model(DampingLaw law) {
  Scenario scenario = Table2();
  for (Contact& c : scenario.contacts) {
    c.damping = law;
    c.restitution = 0.8;
  }
  return RunAndRecord(scenario);
}

void ExpectRestitutions(const Record& record, double first, double second) {
  ASSERT_THAT(record.cycles, SizeIs(2));
  EXPECT_NEAR(record.cycles[0].restitution_out, first, 7e-4);
  EXPECT_NEAR(record.cycles[1].restitution_out, second, 7e-4);
}

std::vector<int> Iterations(const Record& record, std::size_t cycles) {
  std::vector<int> iterations;
  for (std::size_t i = 0; i < cycles; ++i) iterations.push_back(record.cycles.at(i).iterations);
  return iterations;
}

TEST(PaperProcess, GivesTable2) {
  ExpectRestitutions(Table2Model(DampingLaw::kHuntCrossley), 0.8453, 0.8661);
  ExpectRestitutions(Table2Model(DampingLaw::kFlores), 0.8020, 0.8306);
  const Record described = RunAndRecord(Table2());
  ExpectRestitutions(described, 0.8067, 0.7059);
  EXPECT_THAT(described.iterations, SizeIs(6));  // "After six cycles".
  EXPECT_THAT(described.cycles, Each(Field(&Cycle::status, Cycle::Status::kConverged)));
}

TEST(PaperProcess, GivesTable4AndFig15) {
  const Record record =
      RunAndRecord(AsPaper(testing::SpringWall(), UpdateRule::kPaperNewton, 0.005));
  ASSERT_GE(record.cycles.size(), 11U);
  EXPECT_THAT(Iterations(record, 11), ElementsAre(0, 0, 1, 1, 5, 1, 1, 1, 1, 1, 0));
  const double published[] = {0.0123, 0.0176, 0.0235, 0.0326, 0.0460,
                              0.0581, 0.0739, 0.0894, 0.0990, 0.1044};
  for (std::size_t i = 0; i < 10; ++i) {
    // The two drift apart where the published run was less exact: up to 5 % at the fourth.
    EXPECT_NEAR(record.cycles[i].mu / 1.8e7 / published[i], 1, 0.05) << i;
  }
}

TEST(PaperProcess, NeedsMoreCorrectionsByRatio) {
  const Record record =
      RunAndRecord(AsPaper(testing::SpringWall(), UpdateRule::kPaperRatio, 0.005));
  ASSERT_GE(record.cycles.size(), 11U);
  EXPECT_THAT(Iterations(record, 11), ElementsAre(0, 0, 4, 13, 23, 12, 17, 15, 10, 7, 4));
}

TEST(PaperProcess, EveryRuleComesToTheSameFactors) {
  Scenario exact = testing::TripleChain();
  const Record best = RunAndRecord(exact);
  for (const UpdateRule rule : {UpdateRule::kPaperNewton, UpdateRule::kPaperRatio}) {
    Scenario scenario = AsPaper(testing::TripleChain(), rule, 1e-7);
    scenario.solver.max_iterations = 200;
    const Record record = RunAndRecord(scenario);
    ASSERT_THAT(record.cycles, SizeIs(2));
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(record.cycles[i].status, Cycle::Status::kConverged);
      EXPECT_NEAR(record.cycles[i].mu / best.cycles[i].mu, 1, 1e-5);
    }
  }
}

TEST(PaperProcess, BisectionKeepsItsRootInTheBracket) {
  const Record record =
      RunAndRecord(AsPaper(testing::SpringWall(), UpdateRule::kPaperBisection, 0.005));
  int bracketed = 0;
  for (const Iteration& iteration : record.iterations) {
    for (const Iteration::Unknown& u : iteration.unknowns) {
      if (u.update != Iteration::Update::kBisection) continue;
      ++bracketed;
      EXPECT_LT(u.bracket_low, u.bracket_high);
    }
  }
  EXPECT_GT(bracketed, 5);
}

// The largest force comes before the largest deformation, and the works still add up.
TEST(PaperProcess, SplitAtPeakForceMovesWorkFromOnePhaseToTheOther) {
  Scenario at_force = Table2();
  for (Contact& c : at_force.contacts) {
    c.damping = DampingLaw::kGiven;
    c.mu = 2e8;
  }
  Scenario at_deformation = at_force;
  at_deformation.solver.phase_split = PhaseSplit::kPeakDeformation;
  const Record force = RunAndRecord(at_force);
  const Record deformation = RunAndRecord(at_deformation);
  ASSERT_THAT(force.cycles, SizeIs(2));
  for (std::size_t i = 0; i < 2; ++i) {
    const Cycle& f = force.cycles[i];
    const Cycle& d = deformation.cycles[i];
    EXPECT_LT(f.turn_time, d.turn_time);
    EXPECT_LT(f.work_compression, d.work_compression);
    EXPECT_NEAR(f.work_compression + f.work_restitution, d.work_compression + d.work_restitution,
                1e-12 * d.work_compression);
    EXPECT_NEAR(f.dissipated_compression + f.dissipated_restitution,
                d.dissipated_compression + d.dissipated_restitution, 1e-12 * d.work_compression);
    EXPECT_LT(f.identity_residual, 1e-7);
  }
}

}  // namespace
}  // namespace contact
