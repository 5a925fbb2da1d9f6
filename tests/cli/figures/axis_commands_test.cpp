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
