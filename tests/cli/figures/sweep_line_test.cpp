#include "cli/figures/heat_map/sweep_line.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cli/base/failure.h"
#include "cli/figures/gnuplot_script.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsNan;
using testing::Pair;
using testing::SizeIs;

v1::Job LineSweep() {
  v1::Job job;
  v1::Sweep& sweep = *job.mutable_sweep();
  sweep.mutable_base()->set_title("a sweep");
  sweep.mutable_base()->add_bodies()->set_name("B1");
  sweep.add_axes()->set_field("bodies[0].mass_kg");
  sweep.add_metrics("cycles[B1-B2].peak_force_n");
  return job;
}

// Cells at these values of the axis, whose metric is 10 times as large.
SweepCells LineCells(const std::vector<double>& values) {
  SweepCells cells;
  for (std::size_t i = 0; i < values.size(); ++i) {
    v1::SweepCell& cell = cells[static_cast<int>(i)];
    cell.add_values(values[i]);
    cell.add_metrics(10 * values[i]);
    cell.set_state(v1::Job::SUCCEEDED);
    cell.set_convergence(v1::Job::FULL);
  }
  return cells;
}

TEST(SweepLine, GoesThroughTheCellsInTheOrderOfTheirValues) {
  const Figure figure =
      SweepLineFigure(LineSweep(), LineCells({2, 1, 3}), 0, false);  // Drawn at random.
  ASSERT_THAT(figure.panels, SizeIs(1));
  const Figure::Panel& panel = figure.panels[0];
  ASSERT_THAT(panel.curves, SizeIs(1));
  EXPECT_THAT(panel.curves[0].x, ElementsAre(1, 2, 3));
  EXPECT_THAT(panel.curves[0].y, ElementsAre(10, 20, 30));
  EXPECT_EQ(panel.x_label, "mass of B1 [kg]");
  EXPECT_EQ(panel.y_label, "peak force of B1-B2 [N]");
  EXPECT_EQ(figure.title, "a sweep");
  EXPECT_EQ(figure.note, "");
  EXPECT_FALSE(panel.log_x || panel.log_y);
}

TEST(SweepLine, AxisOfAnEnumHasItsWordsAtTheTics) {
  v1::Job job = LineSweep();
  EXPECT_THAT(SweepLineFigure(job, LineCells({2, 6}), 0, false).panels[0].x_words, IsEmpty());
  job.mutable_sweep()->mutable_axes(0)->set_field("contacts[0].damping");
  EXPECT_THAT(SweepLineFigure(job, LineCells({2, 6}), 0, false).panels[0].x_words,
              ElementsAre(Pair(2, "EXACT"), Pair(6, "FLORES")));
}

TEST(SweepLine, IsBrokenWhereACellFailedAndCrossedWhereItDidNotConverge) {
  SweepCells cells = LineCells({1, 2, 3, 4});
  cells[1].set_state(v1::Job::FAILED);
  cells[2].set_convergence(v1::Job::PARTIAL);
  const Figure figure = SweepLineFigure(LineSweep(), cells, 0, false);
  const auto& curves = figure.panels.at(0).curves;
  ASSERT_THAT(curves, SizeIs(2));
  EXPECT_THAT(curves[0].y, ElementsAre(10, IsNan(), 30, 40));
  EXPECT_EQ(curves[1].mark, Figure::Mark::kEnd);
  EXPECT_THAT(curves[1].x, ElementsAre(3));
  EXPECT_EQ(figure.note, "× not converged; 1 cell failed");
}

TEST(SweepLine, IsBrokenWhereTheEndCutsACellOrItHasNoContact) {
  SweepCells cells = LineCells({1, 2, 3, 4});
  cells[1].add_sources(v1::SweepCell::CUT);
  cells[2].add_sources(v1::SweepCell::NO_CONTACT);
  const Figure figure = SweepLineFigure(LineSweep(), cells, 0, false);
  EXPECT_THAT(figure.panels.at(0).curves.at(0).y, ElementsAre(10, IsNan(), IsNan(), 40));
  EXPECT_EQ(figure.note, "1 cell CUT by the end; 1 cell without contact");
}

TEST(SweepLine, LogarithmicAxisTellsWhatItCannotShow) {
  const Figure figure = SweepLineFigure(LineSweep(), LineCells({-1, 0, 1, 2}), 0, true);
  EXPECT_TRUE(figure.panels.at(0).log_y);
  EXPECT_THAT(figure.panels[0].curves.at(0).y, ElementsAre(IsNan(), IsNan(), 10, 20));
  EXPECT_EQ(figure.note, "2 values <= 0 not shown");
}

TEST(SweepLine, RangeInEqualRatiosHasALogarithmicAxis) {
  v1::Job job = LineSweep();
  job.mutable_sweep()->mutable_axes(0)->mutable_log()->set_low(0.02);
  const Figure figure = SweepLineFigure(job, LineCells({0.02, 0.2, 2}), 0, false);
  EXPECT_TRUE(figure.panels.at(0).log_x);
  EXPECT_THAT(GnuplotScript(figure, GnuplotTerminal(OutputFormat::kSvg), "a.svg"),
              AllOf(HasSubstr("set logscale x\n"), HasSubstr("set xrange [0.01:10]\n")));
}

TEST(SweepLine, NeedsAValue) {
  SweepCells cells = LineCells({1, 2});
  for (auto& [index, cell] : cells) cell.set_state(v1::Job::FAILED);
  EXPECT_THROW(SweepLineFigure(LineSweep(), cells, 0, false), Failure);
  EXPECT_THROW(SweepLineFigure(LineSweep(), {}, 0, false), Failure);
}

}  // namespace
}  // namespace contact::cli
