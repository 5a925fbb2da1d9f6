#include "cli/figures/axis_commands.h"

#include <gmock/gmock.h>

#include <cmath>

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Figure::Panel Points(std::vector<double> x, std::vector<double> y) {
  Figure::Panel panel;
  panel.curves.push_back({.x = std::move(x), .y = std::move(y)});
  return panel;
}

TEST(AxisCommands, LimitsOfPointsThatDifferAreLeftToGnuplot) {
  EXPECT_THAT(
      AxisCommands(Points({0, 1}, {-2, 3})),
      AllOf(HasSubstr("set xrange [*:*] noextend\n"), HasSubstr("set yrange [*:*] noextend\n")));
}

// gnuplot refuses a range without width.
TEST(AxisCommands, OneValueHasARangeAroundIt) {
  EXPECT_THAT(AxisCommands(Points({4, 4}, {0, 0})),
              AllOf(HasSubstr("set xrange [2:6]\n"), HasSubstr("set yrange [-1:1]\n")));
  EXPECT_THAT(AxisCommands(Points({-4}, {1})), HasSubstr("set xrange [-6:-2]\n"));
}

TEST(AxisCommands, OneValueOfALogarithmicAxisHasADecadeOnBothSides) {
  Figure::Panel panel = Points({0, 1}, {100, 100});
  panel.log_y = true;
  EXPECT_THAT(AxisCommands(panel),
              AllOf(HasSubstr("set logscale y\n"), HasSubstr("set yrange [10:1000]\n")));
}

TEST(AxisCommands, LogarithmicAxesEndAtWholeDecadesOfWhatIsAboveZero) {
  Figure::Panel panel = Points({0, 1, 2, 3}, {30, 40, 0, -5});
  panel.log_y = true;
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set yrange [10:100]\n"));
  panel.curves[0].y = {-1, -2, 0, NAN};  // None has a place.
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set yrange [0.1:10]\n"));
}

TEST(AxisCommands, ManyDecadesHaveATicAtEveryNth) {
  Figure::Panel panel = Points({0, 1}, {1e-17, 1e-5});
  panel.log_y = true;
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set ytics 100\n"));
  panel.curves[0].y = {1, 1e8};
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set ytics autofreq\n"));
}

TEST(AxisCommands, TicsHaveTheDigitsThatTellThemApart) {
  EXPECT_THAT(AxisCommands(Points({0, 1}, {0, 0.2})), HasSubstr("set format y '%g'\n"));
  EXPECT_THAT(AxisCommands(Points({0, 1}, {0.2, 0.2003})), HasSubstr("set format y '%g'\n"));
  EXPECT_THAT(AxisCommands(Points({0, 1}, {500, 500.0002})), HasSubstr("set format y '%.10g'\n"));
}

TEST(AxisCommands, RangesAreInTheUnitsShown) {
  Figure::Panel panel = Points({4e-3, 4e-3}, {2e-6, 2e-6});
  panel.x_label = "time [s]";
  panel.y_label = "deformation [m]";
  const PanelUnits units = UnitsOf(panel);
  EXPECT_EQ(units.x.label, "time [ms]");
  EXPECT_EQ(units.y.label, "deformation [µm]");
  EXPECT_THAT(AxisCommands(panel, units),
              AllOf(HasSubstr("set xrange [2:6]\n"), HasSubstr("set yrange [1:3]\n")));
}

TEST(UnitsOf, NamedUnitsWinAndLogarithmicAxesKeepTheirs) {
  Figure::Panel panel = Points({0, 1e-3}, {1e-6, 2e-3});
  panel.x_label = "time [s]";
  panel.y_label = "deformation [m]";
  EXPECT_EQ(UnitsOf(panel, {"kN", "mm"}).y.label, "deformation [mm]");
  EXPECT_EQ(UnitsOf(panel, {"kN", "mm"}).x.label, "time [ms]");
  panel.log_y = true;
  EXPECT_EQ(UnitsOf(panel).y.label, "deformation [m]");
  EXPECT_EQ(UnitsOf(panel, {"um"}).y.label, "deformation [µm]");
}

TEST(AxisCommands, ValuesThatAreNoNumbersDoNotMoveTheRange) {
  EXPECT_THAT(AxisCommands(Points({4, NAN}, {NAN, 1})),
              AllOf(HasSubstr("set xrange [2:6]\n"), Not(HasSubstr("nan"))));
}

TEST(AxisCommands, CountsHaveWholeTicsUntilTheyCrowd) {
  Figure::Panel panel = Points({1, 2, 3}, {0, 1, 2});
  panel.counted_x = true;
  EXPECT_THAT(AxisCommands(panel),
              AllOf(HasSubstr("set xtics 1\n"), HasSubstr("set xrange [0.5:3.5]\n")));
  panel.curves[0].x.resize(21, 3);
  panel.curves[0].y.resize(21, 0);
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set xtics autofreq\n"));
}

TEST(AxisCommands, LowestValueOfAPanelEndsItsAxis) {
  Figure::Panel panel = Points({0, 1}, {0.5, 1});
  panel.lowest_y = 0;
  EXPECT_THAT(AxisCommands(panel), HasSubstr("set yrange [0:*]\n"));
}

}  // namespace
}  // namespace contact::cli
