#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "cli/base/failure.h"
#include "cli/base/text_file.h"
#include "cli/figures/gnuplot.h"
#include "cli/figures/heat_map/contours.h"
#include "cli/figures/heat_map/heat_map.h"
#include "cli/figures/heat_map/heat_map_axes.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::DoubleEq;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

const GnuplotTerminal kMapSvg(OutputFormat::kSvg);

v1::Job MapSweep() {
  v1::Job job;
  v1::Sweep& sweep = *job.mutable_sweep();
  sweep.mutable_base()->set_title("it's a sweep");
  sweep.add_axes()->set_field("bodies[0].mass_kg");
  sweep.add_axes()->set_field("contacts[0].restitution");
  sweep.add_metrics("iterations");
  return job;
}

// A grid whose metric is f(row, column).
template <class F>
SweepCells Grid(int rows, int columns, F f) {
  SweepCells cells;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      v1::SweepCell& cell = cells[row * columns + column];
      cell.add_values(1 + row);
      cell.add_values(0.1 * (1 + column));
      cell.add_metrics(f(row, column));
      cell.set_state(v1::Job::SUCCEEDED);
      cell.set_convergence(v1::Job::FULL);
    }
  }
  return cells;
}

std::string MapScript(const SweepCells& cells, bool contours = false, bool log = false) {
  return HeatMapScript(MapSweep(), cells, HeatScale(cells, 0, log), contours, kMapSvg, "map.svg");
}

struct Point {
  double x, y, level;
};

// The lines that gnuplot finds in a grid.
std::vector<Point> Contours(const std::vector<double>& values, std::size_t columns,
                            const HeatScale& scale) {
  const TempDirectory folder;
  const std::string lines = folder.path() / "lines";
  WriteText(FindContours(values, columns, scale) + "set print '" + lines + "'\nprint $contours\n",
            folder.path() / "script");
  RunGnuplot(folder.path() / "script");
  std::istringstream text(ReadText(lines));
  std::vector<Point> points;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    Point point{};
    if (line.find('#') == std::string::npos && words >> point.x >> point.y >> point.level) {
      points.push_back(point);
    }
  }
  std::erase_if(points, [](const Point& point) { return point.x == 0 && point.level == 0; });
  return points;
}

TEST(HeatMapScript, TicsOfAnEnumAreItsWords) {
  v1::Job job = MapSweep();
  job.mutable_sweep()->mutable_axes(0)->set_field("contacts[0].damping");
  job.mutable_sweep()->mutable_axes(0)->set_label("var:law");
  SweepCells cells = Grid(2, 2, [](int row, int column) { return row + column; });
  for (auto& [index, cell] : cells) {
    cell.set_values(0, index < 2 ? v1::Contact::EXACT : v1::Contact::FLORES);
  }
  EXPECT_THAT(HeatMapScript(job, cells, HeatScale(cells, 0, false), false, kMapSvg, "map.svg"),
              AllOf(HasSubstr("set ytics out nomirror ('EXACT' 0, 'FLORES' 1)"),
                    HasSubstr("set ylabel 'var:law'")));
}

TEST(LogLevels, AreRoundAndWithinTheValues) {
  EXPECT_THAT(LogLevels(0.03, 3), Pointwise(DoubleEq(), {0.05, 0.1, 0.2, 0.5, 1.0, 2.0}));
  EXPECT_THAT(LogLevels(1, 1e5), Pointwise(DoubleEq(), {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}));
  EXPECT_THAT(LogLevels(2.1, 2.9), Pointwise(DoubleEq(), {2.2, 2.4, 2.6, 2.8}));
}

TEST(LogLevels, Ascend) {
  for (const double high : {1.1e-3, 0.02, 7.0, 3e4, 1e12}) {
    const std::vector<double> levels = LogLevels(1e-3, high);
    EXPECT_FALSE(levels.empty());
    EXPECT_TRUE(std::ranges::is_sorted(levels, std::less_equal())) << high;
    EXPECT_GE(levels.front(), 1e-3 * (1 - 1e-12));
    EXPECT_LE(levels.back(), high);
  }
}

TEST(FindContours, LinesOfAPlaneAreStraight) {
  const auto plane = [](double row, double column) { return 2 * row + 3 * column; };
  std::vector<double> values;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 6; ++column) values.push_back(plane(row, column));
  }
  const std::vector<Point> points = Contours(values, 6, HeatScale(Grid(5, 6, plane), 0, false));
  ASSERT_GT(points.size(), 10U);
  for (const Point& point : points) {
    EXPECT_NEAR(plane(point.y, point.x), point.level, 1e-3 * point.level);
  }
}

TEST(FindContours, NoLineGoesBesideAHole) {
  const auto slope = [](double, double column) { return column; };
  std::vector<double> values;
  for (int i = 0; i < 30; ++i) values.push_back(i % 6);
  values[2 * 6 + 3] = NAN;
  for (const Point& point : Contours(values, 6, HeatScale(Grid(5, 6, slope), 0, false))) {
    EXPECT_FALSE(std::abs(point.x - 3) < 0.9 && std::abs(point.y - 2) < 0.9)
        << point.x << ' ' << point.y;
  }
}

TEST(HeatMapScript, HasEachValueAtItsPlace) {
  const std::string script = MapScript(Grid(2, 3, [](int r, int c) { return 10 * r + c; }));
  EXPECT_THAT(script, HasSubstr("$cells << end\n0 0 0\n1 0 1\n2 0 2\n0 1 10\n1 1 11\n2 1 12\n"));
  EXPECT_THAT(script, AllOf(HasSubstr("set xtics out nomirror ('0.1' 0, '0.2' 1, '0.3' 2)"),
                            HasSubstr("set ytics out nomirror ('1' 0, '2' 1)"),
                            HasSubstr("set title 'it''s a sweep'"), HasSubstr("with labels")));
}

TEST(HeatMapScript, MarksCellsThatFailedOrDidNotConverge) {
  SweepCells cells = Grid(2, 2, [](int r, int c) { return r + c; });
  EXPECT_THAT(MapScript(cells), AllOf(Not(HasSubstr("pattern 4")), Not(HasSubstr("set arrow"))));
  cells[1].set_convergence(v1::Job::PARTIAL);
  cells[2].set_state(v1::Job::FAILED);
  EXPECT_THAT(MapScript(cells),
              AllOf(HasSubstr("rectangle from 0.5,-0.5 to 1.5,0.5 front fillcolor"),
                    HasSubstr("pattern 4"), HasSubstr("set arrow from -0.5,0.5 to 0.5,1.5"),
                    Not(HasSubstr("\n0 1 "))));  // The cell that failed has no colour.
}

TEST(HeatMapScript, CellsThatTheEndCutsOrWithoutContactAreGreyAndInTheLegend) {
  SweepCells cells = Grid(2, 2, [](int r, int c) { return r + c; });
  EXPECT_THAT(MapScript(cells), AllOf(Not(HasSubstr("CUT")), Not(HasSubstr("no contact"))));
  cells[1].add_sources(v1::SweepCell::CUT);
  cells[2].add_sources(v1::SweepCell::NO_CONTACT);
  EXPECT_THAT(MapScript(cells),
              AllOf(HasSubstr("rectangle from 0.5,-0.5 to 1.5,0.5 front fillcolor rgb '#b0b0b0'"),
                    HasSubstr("set arrow from 1,-0.5 to 1,0.5 nohead"),
                    HasSubstr("rectangle from -0.5,0.5 to 0.5,1.5 front fillcolor rgb '#e8e8e8'"),
                    HasSubstr("; grey with a bar: CUT by the end; light grey: no contact'"),
                    Not(HasSubstr("\n1 0 1\n")), Not(HasSubstr("white:"))));
}

TEST(HeatMapScript, ManyCellsHaveNoNumbersAndFewTics) {
  const std::string script = MapScript(Grid(40, 40, [](int r, int c) { return r * c; }));
  EXPECT_THAT(script, Not(HasSubstr("with labels")));
  EXPECT_THAT(script, AllOf(HasSubstr("'5' 4, "), Not(HasSubstr("'4' 3"))));  // Every second row.
}

// The places of the tics across, in units of a column.
std::vector<int> TicsAcross(const std::string& script) {
  const std::size_t begin = script.find("set xtics out nomirror (");
  std::istringstream entries(script.substr(begin, script.find(')', begin) - begin));
  std::vector<int> places;
  for (std::string entry; std::getline(entries, entry, ',');) {
    places.push_back(std::stoi(entry.substr(entry.rfind(' '))));
  }
  return places;
}

// At 100 columns of values such as 0.1069, twenty of them would overlap.
TEST(HeatMapScript, TicsAcrossHaveRoomForTheirValuesAndRoundSteps) {
  SweepCells cells = Grid(2, 100, [](int r, int c) { return r * c; });
  for (auto& [index, cell] : cells) cell.set_values(1, 0.3 + 0.00697 * cell.values(1));
  EXPECT_THAT(TicsAcross(MapScript(cells)), testing::ElementsAre(0, 20, 40, 60, 80));
  for (auto& [index, cell] : cells) cell.set_values(1, index % 100);
  const std::vector<int> more = TicsAcross(MapScript(cells));
  EXPECT_EQ(more.at(1), 10);
  EXPECT_EQ(more.size(), 10U);
}

TEST(HeatMapScript, LabelsAreWordsWithUnits) {
  v1::Job job = MapSweep();
  job.mutable_sweep()->mutable_base()->add_bodies()->set_name("ball");
  const SweepCells cells = Grid(2, 2, [](int r, int c) { return r + c; });
  const std::string script =
      HeatMapScript(job, cells, HeatScale(cells, 0, false), false, kMapSvg, "m");
  EXPECT_THAT(script, AllOf(HasSubstr("set ylabel 'mass of ball [kg]'"),
                            HasSubstr("set xlabel 'restitution of contacts[0] [1]'"),
                            HasSubstr("set cblabel 'iterations'")));
}

TEST(HeatMapScript, ContoursNeedTwoValuesAndTwoRows) {
  EXPECT_THAT(MapScript(Grid(3, 3, [](int r, int c) { return r + c; }), true),
              HasSubstr("$contours"));
  EXPECT_THAT(MapScript(Grid(3, 3, [](int, int) { return 1; }), true), Not(HasSubstr("$contours")));
  EXPECT_THAT(MapScript(Grid(1, 9, [](int, int c) { return c; }), true),
              Not(HasSubstr("$contours")));
}

TEST(HeatMapScript, IsOfGridsOfTwoAxes) {
  const SweepCells cells = Grid(2, 2, [](int r, int c) { return r + c; });
  v1::Job job = MapSweep();
  job.mutable_sweep()->add_axes()->set_field("end_time_s");
  const HeatScale scale(cells, 0, false);
  EXPECT_THROW(HeatMapScript(job, cells, scale, false, kMapSvg, "m"), Failure);
  EXPECT_THROW(HeatMapScript(MapSweep(), {}, scale, false, kMapSvg, "m"), Failure);
}

TEST(ColourRange, HasTwoEndsForOneValueOrNone) {
  for (const bool log : {false, true}) {
    for (const double value : {3.0, 0.0, -2.0, static_cast<double>(NAN)}) {
      const ColourRange range(HeatScale(Grid(2, 2, [&](int, int) { return value; }), 0, log));
      EXPECT_LT(range.low, range.high) << value << log;
      if (log) {
        EXPECT_GT(range.low, 0) << value;
      }
    }
  }
}

TEST(HeatMap, TellsHowManyCellsHaveNoValue) {
  const auto none = Grid(2, 3, [](int row, int) { return row == 0 ? std::nan("") : 1.0; });
  EXPECT_THAT(MapScript(none), HasSubstr("white: 3 without value"));
  const auto some =
      Grid(2, 3, [](int row, int column) { return row == 0 ? std::nan("") : 1.0 * column; });
  EXPECT_THAT(MapScript(some, false, true), HasSubstr("white: 1 value <= 0, 3 without value"));
  EXPECT_THAT(MapScript(Grid(2, 3, [](int, int) { return 1.0; })), Not(HasSubstr("white:")));
}

}  // namespace
}  // namespace contact::cli
