#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "cli/text/sweep/render_heat_map.h"
#include "cli/text/sweep/sweep_grid.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;

SweepCells CellsOf(const std::vector<double>& values) {
  SweepCells cells;
  for (const double value : values) {
    v1::SweepCell& cell = cells[static_cast<int>(cells.size())];
    cell.set_state(v1::Job::SUCCEEDED);
    cell.add_metrics(value);
  }
  return cells;
}

v1::Sweep TwoAxes() {
  v1::Sweep sweep;
  sweep.add_axes();
  sweep.add_axes();
  return sweep;
}

// Cells of a table with the values (first, second) of the axes.
SweepCells AtPlaces(const std::vector<std::pair<double, double>>& places) {
  SweepCells cells;
  for (const auto& [first, second] : places) {
    v1::SweepCell& cell = cells[static_cast<int>(cells.size())];
    cell.add_values(first);
    cell.add_values(second);
  }
  return cells;
}

TEST(HeatScale, LeavesOutWhatHasNoLogarithm) {
  const SweepCells cells = CellsOf({-1, 0, 0.01, 1, NAN});
  const HeatScale log(cells, 0, true);
  EXPECT_EQ(log.unshown(), 2);
  EXPECT_EQ(log.valueless(), 1);
  EXPECT_EQ(log.low(), 0.01);
  EXPECT_DOUBLE_EQ(log.Height(0.1), 0.5);
  EXPECT_TRUE(std::isnan(log.Shown(cells.at(0))));
  const HeatScale linear(cells, 0, false);
  EXPECT_EQ(linear.unshown(), 0);
  EXPECT_EQ(linear.low(), -1);
  EXPECT_DOUBLE_EQ(linear.Height(0), 0.5);
}

TEST(HeatScale, HeightGrowsFromTheLowestToTheHighestValue) {
  for (const bool log : {false, true}) {
    const HeatScale scale(CellsOf({0.5, 2, 8, 30}), 0, log);
    EXPECT_EQ(scale.Height(scale.low()), 0);
    EXPECT_EQ(scale.Height(scale.high()), 1);
    EXPECT_LT(scale.Height(2), scale.Height(8));
  }
}

TEST(HeatScale, OneValueStandsAtTheBottom) {
  EXPECT_EQ(HeatScale(CellsOf({3, 3}), 0, false).Height(3), 0);
}

TEST(HeatScale, CellsThatFailedOrLackTheMetricCountForNothing) {
  SweepCells cells = CellsOf({1, 2, 1000});
  cells[2].set_state(v1::Job::FAILED);
  cells[3].set_state(v1::Job::SUCCEEDED);  // Without metrics.
  const HeatScale scale(cells, 0, false);
  EXPECT_EQ(scale.high(), 2);
  EXPECT_TRUE(scale.whole());
  EXPECT_TRUE(std::isnan(scale.Shown(cells[2])));
  EXPECT_TRUE(std::isnan(scale.Shown(cells[3])));
}

TEST(HeatScale, NumbersThatAreNotKnownAreCountedByTheirReason) {
  SweepCells cells = CellsOf({1, 2, 1000, NAN, NAN});
  cells[2].add_sources(v1::SweepCell::CUT);
  cells[3].add_sources(v1::SweepCell::NO_CONTACT);
  cells[4].add_sources(v1::SweepCell::RESULT);
  const HeatScale scale(cells, 0, false);
  EXPECT_EQ(scale.high(), 2);
  EXPECT_TRUE(std::isnan(scale.Shown(cells[2])));
  EXPECT_EQ(scale.cut(), 1);
  EXPECT_EQ(scale.untouched(), 1);
  EXPECT_EQ(scale.valueless(), 1);
}

TEST(HeatScale, KnowsWholeNumbers) { EXPECT_FALSE(HeatScale(CellsOf({1, 2.5}), 0, false).whole()); }

TEST(HeatScale, OfNoValuesHasItsEndsTheWrongWayRound) {
  const HeatScale scale(CellsOf({NAN}), 0, false);
  EXPECT_GT(scale.low(), scale.high());
}

TEST(SweepGrid, HasTheValuesOfTheAxesInTheOrderOfTheCells) {
  const SweepCells cells = AtPlaces({{2, 0.9}, {2, 0.1}, {1, 0.9}, {1, 0.1}});
  const auto grid = SweepGrid::Of(TwoAxes(), cells);
  ASSERT_TRUE(grid);
  EXPECT_THAT(grid->rows(), ElementsAre(2, 1));
  EXPECT_THAT(grid->columns(), ElementsAre(0.9, 0.1));
  for (const auto& [index, cell] : cells) {
    EXPECT_EQ(grid->At(grid->RowOf(cell), grid->ColumnOf(cell)), &cell);
  }
}

TEST(SweepGrid, HasHolesWhereNoCellIs) {
  const SweepCells cells = AtPlaces({{1, 1}, {2, 2}});
  EXPECT_EQ(SweepGrid::Of(TwoAxes(), cells)->At(0, 1), nullptr);
}

TEST(SweepGrid, IsOfTwoAxesThatAreCombined) {
  const SweepCells cells = AtPlaces({{1, 1}});
  v1::Sweep sweep = TwoAxes();
  EXPECT_FALSE(SweepGrid::Of(sweep, {}));
  sweep.set_combination(v1::Sweep::ZIP);
  EXPECT_FALSE(SweepGrid::Of(sweep, cells));
  sweep = TwoAxes();
  sweep.add_axes();
  EXPECT_FALSE(SweepGrid::Of(sweep, cells));
}

}  // namespace
}  // namespace contact::cli
