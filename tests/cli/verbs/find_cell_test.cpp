#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/sweep/sweep_cell.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

// A grid of 2 velocities and 3 restitutions, all solved.
class FindCellTest : public testing::Test {
 protected:
  FindCellTest() {
    v1::Sweep& sweep = *job_.mutable_sweep();
    job_.set_name("jobs/abc");
    v1::Body& body = *sweep.mutable_base()->add_bodies();
    body.set_name("A");
    body.set_mass_kg(1);
    sweep.add_axes()->set_field("bodies[0].velocity_m_per_s");
    sweep.add_axes()->set_field("bodies[0].mass_kg");
    sweep.add_metrics("iterations");
    int index = 0;
    for (const double velocity : {0.1, 0.2}) {
      for (const double mass : {1.0, 2.0, 3.0}) AddCell(index++, velocity, mass);
    }
  }

  void AddCell(int index, double velocity, double mass) {
    v1::SweepCell& cell = cells_[index];
    cell.set_index(index);
    cell.add_values(velocity);
    cell.add_values(mass);
    cell.add_metrics(10 * velocity + mass);
    cell.set_state(v1::Job::SUCCEEDED);
    cell.set_convergence(v1::Job::FULL);
  }

  int Found(const std::string& text) const { return FindCell(job_.sweep(), cells_, text).index(); }

  std::string Refusal(const std::string& text) const {
    try {
      Found(text);
      return "";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      return failure.what();
    }
  }

  v1::Job job_;
  SweepCells cells_;
};

TEST_F(FindCellTest, NumberIsTheIndex) {
  for (int i = 0; i < 6; ++i) EXPECT_EQ(Found(std::to_string(i)), i);
  EXPECT_EQ(Refusal("6"), "there is no cell 6; the last is 5");
}

TEST_F(FindCellTest, ValuesNameTheCellInAnyOrder) {
  EXPECT_EQ(Found("bodies[0].velocity_m_per_s=0.2,bodies[0].mass_kg=3"), 5);
  EXPECT_EQ(Found("mass_kg=3,velocity_m_per_s=0.2"), 5);
}

TEST_F(FindCellTest, SixDigitsAreEnough) {
  EXPECT_EQ(Found("velocity_m_per_s=0.1000001,mass_kg=2"), 1);
  EXPECT_THAT(Refusal("velocity_m_per_s=0.101,mass_kg=2"), HasSubstr("the nearest value is 0.1"));
}

TEST_F(FindCellTest, ValuesThatNameSeveralCellsAreNotEnough) {
  EXPECT_EQ(Refusal("mass_kg=2"), "2 cells have mass_kg=2: 1, 4, …; name more fields");
}

TEST_F(FindCellTest, FieldThatIsNoAxisComesWithTheNearest) {
  EXPECT_THAT(Refusal("mas_kg=2"), HasSubstr("did you mean 'mass_kg'?"));
  EXPECT_THAT(Refusal("restitution=2"), HasSubstr("axes are bodies[0].velocity_m_per_s"));
}

TEST_F(FindCellTest, TextWithoutANumberIsExplained) {
  EXPECT_THAT(Refusal("heavy"), HasSubstr("expected the number of a cell, or FIELD=VALUE"));
  EXPECT_THAT(Refusal("mass_kg=heavy"), HasSubstr("expected the number of a cell"));
}

TEST_F(FindCellTest, CombinationWithoutACellIsTold) {
  cells_.erase(5);
  EXPECT_EQ(Refusal("velocity_m_per_s=0.2,mass_kg=3"),
            "no cell has velocity_m_per_s=0.2,mass_kg=3 together");
}

TEST_F(FindCellTest, WordsAndVariablesNameTheCellToo) {
  v1::Sweep::Axis& axis = *job_.mutable_sweep()->mutable_axes(0);
  axis.set_field("contacts[0].damping");
  axis.set_label("var:law");
  for (auto& [index, cell] : cells_) {
    cell.set_values(0, index < 3 ? v1::Contact::EXACT : v1::Contact::FLORES);
  }
  EXPECT_EQ(Found("var:law=FLORES,mass_kg=2"), 4);
  EXPECT_EQ(Found("law=exact,mass_kg=2"), 1);
  EXPECT_EQ(Refusal("law=HUNT_CROSSLEY,mass_kg=2"), "no cell has var:law=HUNT_CROSSLEY");
  EXPECT_THAT(RenderCell(job_, cells_.at(4), Style()), testing::ContainsRegex("var:law +FLORES\n"));
}

TEST_F(FindCellTest, ScenarioIsTheBaseWithTheValuesOfTheCell) {
  const v1::Scenario scenario = ScenarioOf(job_.sweep(), cells_.at(5));
  EXPECT_DOUBLE_EQ(scenario.bodies(0).velocity_m_per_s(), 0.2);
  EXPECT_DOUBLE_EQ(scenario.bodies(0).mass_kg(), 3);
  EXPECT_EQ(scenario.bodies(0).name(), "A");
}

TEST_F(FindCellTest, CellIsShownWithValuesAndMetrics) {
  const std::string text = RenderCell(job_, cells_.at(4), Style());
  EXPECT_THAT(text, HasSubstr("jobs/abc cell 4  SUCCEEDED  convergence FULL"));
  EXPECT_THAT(text, testing::ContainsRegex("bodies\\[0\\].mass_kg +2\n"));
  EXPECT_THAT(text, testing::ContainsRegex("iterations +4\n"));
}

TEST_F(FindCellTest, MetricOfACutCycleIsShownAsCut) {
  v1::SweepCell& cell = cells_.at(4);
  cell.add_sources(v1::SweepCell::CUT);
  cell.set_cycles(2);
  cell.set_cycles_cut(1);
  const std::string text = RenderCell(job_, cell, Style());
  EXPECT_THAT(text, HasSubstr("convergence FULL, 1 cut\n"));
  EXPECT_THAT(text, testing::ContainsRegex("iterations +CUT\n"));
}

TEST_F(FindCellTest, FailedCellSaysWhyAndHasNoConvergence) {
  v1::SweepCell& cell = cells_.at(4);
  cell.set_state(v1::Job::FAILED);
  cell.set_state_reason("SCENARIO_INVALID");
  cell.set_message("mass_kg is 0");
  cell.clear_metrics();
  const std::string text = RenderCell(job_, cell, Style());
  EXPECT_THAT(text, HasSubstr("SCENARIO_INVALID: mass_kg is 0"));
  EXPECT_THAT(text, testing::Not(HasSubstr("convergence")));
  EXPECT_THAT(text, testing::ContainsRegex("iterations +-\n"));
}

v1::Job Ended(int cycles) {
  v1::Job job;
  job.set_name("jobs/abc");
  for (int i = 0; i < cycles; ++i) job.add_cycles();
  return job;
}

TEST(NextStepsTest, PlotIsOfferedOnlyIfThereIsMotionToDraw) {
  EXPECT_THAT(NextSteps(Ended(1)), HasSubstr("contactctl plot abc hysteresis"));
  EXPECT_THAT(NextSteps(Ended(0)), testing::Not(HasSubstr("plot")));
  v1::Job ledger = Ended(1);
  ledger.mutable_scenario()->mutable_output()->set_ledger_only(true);
  EXPECT_THAT(NextSteps(ledger), testing::Not(HasSubstr("plot")));
}

TEST(NextStepsTest, PartlyConvergedRunIsToldWhichCyclesAndWhatToTry) {
  v1::Job job = Ended(1);
  job.mutable_cycles(0)->set_status(v1::Cycle::INFEASIBLE);
  job.mutable_scenario()->mutable_solver()->set_restitution_scope(v1::Solver::CYCLE);
  EXPECT_THAT(NextSteps(job), testing::Not(HasSubstr("Try:")));
  job.set_convergence(v1::Job::PARTIAL);
  EXPECT_THAT(NextSteps(job), HasSubstr("contactctl describe abc --only-missed"));
  EXPECT_THAT(NextSteps(job), HasSubstr("Try:   --set solver.restitution_scope=AUTO"));
}

}  // namespace
}  // namespace contact::cli
