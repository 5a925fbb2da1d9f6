#include "cli/text/sweep/render_sweep.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/text/sweep/render_heat_map.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

v1::Job SweepJob() {
  v1::Job job;
  job.set_name("jobs/s");
  job.set_state(v1::Job::SUCCEEDED);
  v1::Sweep& sweep = *job.mutable_sweep();
  sweep.add_axes()->set_field("bodies[0].mass_kg");
  sweep.add_axes()->set_field("contacts[0].restitution");
  sweep.add_metrics("iterations");
  job.mutable_progress()->set_cells(4);
  job.mutable_progress()->set_cells_done(4);
  job.mutable_progress()->set_cells_failed(1);
  job.mutable_progress()->set_cells_not_converged(1);
  return job;
}

v1::SweepCell Cell(int index, double mass, double restitution, double iterations) {
  v1::SweepCell cell;
  cell.set_index(index);
  cell.add_values(mass);
  cell.add_values(restitution);
  cell.add_metrics(iterations);
  cell.set_state(v1::Job::SUCCEEDED);
  cell.set_convergence(v1::Job::FULL);
  return cell;
}

SweepCells SweptCells() {
  SweepCells cells{{0, Cell(0, 0.5, 0.9, 2)},
                   {1, Cell(1, 0.5, 0.8, 10)},
                   {2, Cell(2, 2, 0.9, 50)},
                   {3, Cell(3, 2, 0.8, NAN)}};
  cells[2].set_convergence(v1::Job::PARTIAL);
  cells[3].set_state(v1::Job::FAILED);
  cells[3].clear_convergence();
  cells[3].set_state_reason("NUMERIC");
  cells[3].set_message("at 1 s, \"B1\"");
  return cells;
}

TEST(RenderSweep, SaysWhatBecameOfEveryCell) {
  const std::string text = RenderSweep(SweepJob(), SweptCells(), {});
  EXPECT_THAT(text, HasSubstr("jobs/s  SUCCEEDED  4 of 4 cells, 1 failed, 1 not converged"));
  EXPECT_THAT(text,
              HasSubstr("   2                  2                      0.9          50  PARTIAL"));
  EXPECT_THAT(text,
              HasSubstr("   3                  2                      0.8           -  NUMERIC"));
}

TEST(RenderSweep, HeatMapMarksWhatDidNotConvergeOrFailed) {
  EXPECT_EQ(RenderHeatMap(SweepJob().sweep(), SweptCells(), 0, {}),
            "\niterations over bodies[0].mass_kg (down) and contacts[0].restitution (across, "
            "0.9 … 0.8)\n"
            "0.5  ░░ ░░\n"
            "  2  █! ××\n"
            "░ 2 … █ 50;  ! not converged, ×× failed, -- no value\n");
}

// Cells as those above, but cell 0 is cut by the end of the run and cell 1 touches nothing.
SweepCells CellsAtTheEnd() {
  SweepCells cells = SweptCells();
  cells[0].add_sources(v1::SweepCell::CUT);
  cells[0].set_cycles(3);
  cells[0].set_cycles_cut(2);
  cells[1].add_sources(v1::SweepCell::NO_CONTACT);
  cells[1].set_cycles(0);
  return cells;
}

TEST(RenderSweep, MetricOfACutCycleOrOfNoContactIsNoNumber) {
  const std::string text = RenderSweep(SweepJob(), CellsAtTheEnd(), {});
  EXPECT_THAT(text, testing::ContainsRegex("0 +0.5 +0.9 +CUT +FULL, 2 cut\n"));
  EXPECT_THAT(text, testing::ContainsRegex("1 +0.5 +0.8 +no contact +FULL, no contact\n"));
  EXPECT_THAT(SweepCsv(SweepJob().sweep(), CellsAtTheEnd()),
              HasSubstr("\n0,0.5,0.9,nan,SUCCEEDED,FULL,iterations: CUT\n"
                        "1,0.5,0.8,nan,SUCCEEDED,FULL,no contact\n"));
}

TEST(RenderSweep, HeatMapHasMarksForCutCellsAndThoseWithoutContact) {
  EXPECT_THAT(RenderHeatMap(SweepJob().sweep(), CellsAtTheEnd(), 0, {}),
              HasSubstr("0.5  ][ ()\n"
                        "  2  ░! ××\n"
                        "░ 50 … █ 50;  ! not converged, ×× failed, -- no value, ][ CUT by the end, "
                        "() no contact\n"));
}

TEST(RenderSweep, HeatMapShowsHolesOfAnUnfinishedSweep) {
  SweepCells cells = SweptCells();
  cells.erase(1);
  EXPECT_THAT(RenderHeatMap(SweepJob().sweep(), cells, 0, {}), HasSubstr("0.5  ░░ ··\n"));
}

TEST(RenderSweep, HeatMapIsOfGridsOfTwoAxesThatFit) {
  v1::Sweep sweep = SweepJob().sweep();
  EXPECT_EQ(RenderHeatMap(sweep, SweptCells(), 0, {.width = 10}), "");
  EXPECT_EQ(RenderHeatMap(sweep, SweptCells(), 1, {}), "");
  sweep.set_combination(v1::Sweep::ZIP);
  EXPECT_EQ(RenderHeatMap(sweep, SweptCells(), 0, {}), "");
}

TEST(SweepJson, IsOneDocumentInWhichEveryCellHasItsIndex) {
  SweepCells cells = SweptCells();
  cells[0].Clear();  // Nothing is known of it, not even an index in the line of the message.
  const auto json = nlohmann::json::parse(SweepJson(SweepJob(), cells));
  EXPECT_EQ(json["job"]["name"], "jobs/s");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(json["cells"][i]["index"], i);
  EXPECT_EQ(json["cells"][3]["message"], "at 1 s, \"B1\"");
  EXPECT_EQ(json["cells"][2]["values"], nlohmann::json::array({2, 0.9}));
}

TEST(RenderSweep, CsvQuotesWhatNeedsIt) {
  EXPECT_EQ(SweepCsv(SweepJob().sweep(), SweptCells()),
            "cell,bodies[0].mass_kg,contacts[0].restitution,iterations,state,convergence,message\n"
            "0,0.5,0.9,2,SUCCEEDED,FULL,\n"
            "1,0.5,0.8,10,SUCCEEDED,FULL,\n"
            "2,2,0.9,50,SUCCEEDED,PARTIAL,\n"
            "3,2,0.8,nan,FAILED,,\"NUMERIC: at 1 s, \"\"B1\"\"\"\n");
}

// Two laws by two restitutions, the first axis over a variable.
v1::Job OfLaws() {
  v1::Job job = SweepJob();
  v1::Sweep& sweep = *job.mutable_sweep();
  sweep.mutable_axes(0)->set_field("contacts[A-B].damping");
  sweep.mutable_axes(0)->set_label("var:law");
  return job;
}

SweepCells CellsOfLaws() {
  SweepCells cells;
  int index = 0;
  for (const int law : {v1::Contact::EXACT, v1::Contact::FLORES}) {
    for (const double restitution : {0.9, 0.8}) {
      cells[index] = Cell(index, law, restitution, index);
      ++index;
    }
  }
  return cells;
}

TEST(RenderSweep, ValuesOfAnEnumAreItsWordsEverywhere) {
  const std::string text = RenderSweep(OfLaws(), CellsOfLaws(), {});
  EXPECT_THAT(text, testing::ContainsRegex("1 +EXACT +0.8 +1 +FULL"));
  EXPECT_THAT(text, testing::ContainsRegex("2 +FLORES +0.9 +2 +FULL"));
  EXPECT_THAT(SweepCsv(OfLaws().sweep(), CellsOfLaws()),
              testing::AllOf(testing::StartsWith("cell,var:law,contacts[0].restitution,"),
                             HasSubstr("\n3,FLORES,0.8,3,SUCCEEDED")));
  EXPECT_THAT(RenderHeatMap(OfLaws().sweep(), CellsOfLaws(), 0, {}),
              HasSubstr("over var:law (down) and contacts[0].restitution (across, 0.9 … 0.8)\n"
                        " EXACT  "));
}

}  // namespace
}  // namespace contact::cli
