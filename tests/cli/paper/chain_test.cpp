#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "cli/paper/items.h"
#include "testing/fake_lab.h"

namespace contact::cli {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::SizeIs;

// A chain as one of its models is run.
struct Asked {
  v1::Contact::Damping damping;
  v1::Solver::Method method;
  v1::Solver::PhaseSplit split;
};

std::vector<Asked> What(const FakeLab& lab, std::size_t first, std::size_t count) {
  std::vector<Asked> asked;
  for (std::size_t i = first; i < first + count; ++i) {
    const v1::Scenario& scenario = lab.asked.at(i);
    asked.push_back({scenario.contacts(1).damping(), scenario.solver().method(),
                     scenario.solver().phase_split()});
  }
  return asked;
}

TEST(ChainTables, PublishedRunsFollowThePaperAndConvergedOnesTheDefaults) {
  FakeLab lab;
  MakeChainTables(lab);
  for (const Asked& run : What(lab, 0, 3)) {
    EXPECT_EQ(run.method, v1::Solver::RK4);
    EXPECT_EQ(run.split, v1::Solver::PEAK_FORCE);
  }
  for (const Asked& run : What(lab, 3, 3)) {
    EXPECT_EQ(run.method, v1::Solver::METHOD_UNSPECIFIED);
    EXPECT_EQ(run.split, v1::Solver::PHASE_SPLIT_UNSPECIFIED);
  }
  for (const std::size_t first : {0U, 3U}) {
    const std::vector<Asked> runs = What(lab, first, 3);
    EXPECT_EQ(runs[0].damping, v1::Contact::HUNT_CROSSLEY);
    EXPECT_EQ(runs[1].damping, v1::Contact::FLORES);
    EXPECT_EQ(runs[2].damping, v1::Contact::DAMPING_UNSPECIFIED);
  }
}

TEST(ChainTables, NamedLawsGiveBothContactsTheFactorOfTheFirst) {
  FakeLab lab;
  MakeChainTables(lab);
  for (const std::size_t law : {0U, 1U, 3U, 4U}) {
    for (const v1::Contact& contact : lab.asked.at(law).contacts()) {
      EXPECT_EQ(contact.restitution(), 0.8);
      EXPECT_EQ(contact.reference_velocity_m_per_s(), 0.2);
    }
  }
  for (const std::size_t described : {2U, 5U}) {
    EXPECT_EQ(lab.asked.at(described).contacts(1).restitution(), 0.7);
  }
}

TEST(ChainTables, RecordNoTrajectory) {
  FakeLab lab;
  MakeChainTables(lab);
  EXPECT_THAT(lab.asked, SizeIs(6 + 2 * 50));
  for (const v1::Scenario& scenario : lab.asked) EXPECT_TRUE(scenario.output().ledger_only());
}

TEST(ChainTables, EveryCellOfTable3IsRunBothWays) {
  FakeLab lab;
  MakeChainTables(lab);
  std::map<std::pair<double, double>, int> runs;
  for (std::size_t i = 6; i < lab.asked.size(); ++i) {
    const v1::Scenario& scenario = lab.asked[i];
    const bool paper = scenario.solver().method() == v1::Solver::RK4;
    EXPECT_EQ(scenario.contacts(0).restitution(), scenario.contacts(1).restitution());
    runs[{scenario.bodies(0).velocity_m_per_s(), scenario.contacts(0).restitution()}] +=
        paper ? 1 : 100;
  }
  EXPECT_THAT(runs, SizeIs(50));
  EXPECT_THAT(runs, testing::Each(testing::Pair(testing::_, 101)));
}

TEST(ChainFigures, DataHaveAllRunsOneAfterTheOther) {
  FakeLab lab;
  const std::vector<PaperItem> items = MakeChainFigures(lab);
  ASSERT_THAT(items, SizeIs(4));
  for (const PaperItem& item : items) {
    const Data& data = item.data.at(0);
    EXPECT_EQ(data.name, item.id);
    EXPECT_THAT(data.rows, SizeIs(4 * 3));  // Four runs of three samples.
    EXPECT_TRUE(std::ranges::is_sorted(data.rows, {}, [](const auto& row) { return row[0]; }));
    EXPECT_THAT(data.columns, testing::AllOf(Contains("run"), Contains("time [s]")));
    EXPECT_THAT(data.note, testing::AllOf(testing::HasSubstr("run 0 is Hunt"),
                                          testing::HasSubstr("3 the same converged")));
  }
}

TEST(ChainFigures, ColumnsHoldWhatTheirHeadersSay) {
  FakeLab lab;
  const std::vector<PaperItem> items = MakeChainFigures(lab);
  const Data& data = items[3].data.at(0);
  EXPECT_THAT(data.columns, ElementsAre("run", "time [s]", "deformation_b12 [m]", "force_b12 [N]",
                                        "deformation_b23 [m]", "force_b23 [N]"));
  EXPECT_THAT(data.rows[1], ElementsAre(0, 1e-3, 1, 1, 1, 1));
}

TEST(ChainFigures, CurvesOfTheModelsAreNamedAfterThem) {
  FakeLab lab;
  const std::vector<PaperItem> items = MakeChainFigures(lab);
  const auto& curves = items[1].figure->panels.at(0).curves;
  for (const char* model :
       {"Hunt and Crossley, B1-B2", "Flores et al., B1-B2", "Described method, B1-B2"}) {
    EXPECT_THAT(curves, Contains(Field(&Figure::Curve::label, model)));
  }
}

TEST(SpringItems, CurvesAreNamedAsInThePaper) {
  FakeLab lab;
  const std::vector<PaperItem> items = MakeSpringItems(lab);
  const auto force = std::ranges::find(items, "fig15", &PaperItem::id);
  const auto label = [](const char* text) { return Field(&Figure::Curve::label, text); };
  const auto& curves = force->figure->panels.at(0).curves;
  EXPECT_THAT(curves, Contains(label("contact force")).Times(1));
  EXPECT_THAT(curves, Contains(label("equivalent external force")).Times(1));
  EXPECT_THAT(curves, Contains(label("start of a cycle")).Times(1));
  EXPECT_THAT(curves, Contains(label("end of a cycle")).Times(1));
  EXPECT_THAT(curves, testing::Not(Contains(label("ball-wall"))));
}

TEST(SpringItems, CyclesStandBesideEachCurveAsData) {
  FakeLab lab;
  for (const PaperItem& item : MakeSpringItems(lab)) {
    if (!item.figure) continue;
    ASSERT_THAT(item.data, SizeIs(2)) << item.id;
    EXPECT_EQ(item.data[1].name, item.id + "_cycles");
    EXPECT_THAT(item.data[1].rows, SizeIs(11));
  }
}

TEST(SpringItems, FactorsAreComparedInSecondsAMetre) {
  // μ/k of the first cycle as printed in Fig. 15.
  class Printed : public Lab {
   public:
    std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios) override {
      std::vector<Solved> solved = lab_.Solve(scenarios);
      for (Solved& run : solved) {
        for (v1::Cycle& cycle : *run.job.mutable_cycles()) cycle.set_mu(0.0123 * 1.8e7);
      }
      return solved;
    }

   private:
    FakeLab lab_;
  } lab;
  const std::vector<PaperItem> items = MakeSpringItems(lab);
  const auto force = std::ranges::find(items, "fig15", &PaperItem::id);
  ASSERT_THAT(force->numbers, SizeIs(10));
  EXPECT_NEAR(force->numbers[0].process, 0.0123, 1e-15);
  EXPECT_TRUE(force->numbers[0].holds());
  EXPECT_FALSE(force->numbers[1].holds());  // Printed: 0.0176.
}

TEST(SpringItems, RunsBothUpdatesOfThePaperAndTheDefault) {
  FakeLab lab;
  MakeSpringItems(lab);
  ASSERT_THAT(lab.asked, SizeIs(3));
  EXPECT_EQ(lab.asked[0].solver().update(), v1::Solver::PAPER_NEWTON);
  EXPECT_EQ(lab.asked[1].solver().update(), v1::Solver::PAPER_RATIO);
  EXPECT_FALSE(lab.asked[2].has_solver());
}

TEST(DampingStudy, KeepsOnlySamplesInContact) {
  FakeLab lab;  // Whose last sample has a deformation of -1.
  const std::vector<PaperItem> items = MakeDampingStudy(lab);
  EXPECT_EQ(items.at(0).id, "fig3");
  EXPECT_THAT(items[0].data.at(0).rows, SizeIs(5 * 2));
  for (const auto& row : items[0].data[0].rows) EXPECT_GE(row[1], 0);
}

TEST(DampingStudy, RunsEveryLawOfTable1OverTheWholeRange) {
  FakeLab lab;
  const std::vector<PaperItem> items = MakeDampingStudy(lab);
  const Data& data = items.at(1).data.at(0);
  EXPECT_THAT(data.columns,
              ElementsAre("restitution_in", "restitution_out_hunt_crossley",
                          "restitution_out_lankarani_nikravesh", "restitution_out_flores",
                          "restitution_out_hu_guo", "restitution_out_paper_eq23"));
  EXPECT_THAT(data.rows, SizeIs(19));
  EXPECT_NEAR(data.rows.front()[0], 0.05, 1e-12);
  EXPECT_NEAR(data.rows.back()[0], 0.95, 1e-12);
}

}  // namespace
}  // namespace contact::cli
