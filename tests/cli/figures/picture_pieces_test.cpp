#include <gmock/gmock.h>

#include <limits>

#include "cli/base/latex.h"
#include "cli/export/matlab_names.h"
#include "cli/figures/contours.h"
#include "cli/figures/gnuplot.h"
#include "cli/text/heat_scale.h"

namespace contact::cli {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::Pointwise;

SweepCells Cells(const std::vector<double>& values) {
  SweepCells cells;
  for (const double value : values) {
    v1::SweepCell& cell = cells[static_cast<int>(cells.size())];
    cell.set_state(v1::Job::SUCCEEDED);
    cell.add_metrics(value);
  }
  return cells;
}

TEST(LatexText, LeavesNothingThatIsACommand) {
  EXPECT_EQ(LatexText(R"(\input{x} 5% a_b #&$ ^~ <|>)"),
            R"(\textbackslash{}input\{x\} 5\% a\_b \#\&\$ \textasciicircum{}\textasciitilde{} )"
            R"(\textless{}\textbar{}\textgreater{})");
  EXPECT_EQ(LatexText("μ/k, ε², Stöße"), R"($\mu$/k, $\varepsilon$$^2$, Stöße)");
}

TEST(Medium, QuotesForGnuplotAndForTex) {
  EXPECT_EQ(Medium("svg").Text("it's 5%"), "'it''s 5%'");
  EXPECT_EQ(Medium("tikz").Text("it's 5%"), "'it''s 5\\%'");
  EXPECT_EQ(Medium("txt").Font(9), "");
}

TEST(HeatScale, LeavesOutWhatHasNoLogarithm) {
  const SweepCells cells = Cells({-1, 0, 0.01, 1, std::numeric_limits<double>::quiet_NaN()});
  const HeatScale log(cells, 0, true);
  EXPECT_EQ(log.unshown(), 2);
  EXPECT_EQ(log.low(), 0.01);
  EXPECT_DOUBLE_EQ(log.Height(0.1), 0.5);
  const HeatScale linear(cells, 0, false);
  EXPECT_EQ(linear.unshown(), 0);
  EXPECT_EQ(linear.low(), -1);
  EXPECT_DOUBLE_EQ(linear.Height(0), 0.5);
}

TEST(LogLevels, AreRoundAndWithinTheValues) {
  EXPECT_THAT(LogLevels(0.03, 3), Pointwise(DoubleEq(), {0.05, 0.1, 0.2, 0.5, 1.0, 2.0}));
  EXPECT_THAT(LogLevels(1, 1e5), Pointwise(DoubleEq(), {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}));
  EXPECT_THAT(LogLevels(2.1, 2.9), Pointwise(DoubleEq(), {2.2, 2.4, 2.6, 2.8}));
}

TEST(MatlabNames, AreValidAndStayApart) {
  EXPECT_THAT(MatlabNames({"time", "B1-B2.mu", "B1_B2.mu", "1.velocity", "_a"}),
              ElementsAre("time", "B1_B2_mu", "B1_B2_mu_2", "x1_velocity", "x_a"));
  const std::string longest(63, 'a');
  EXPECT_THAT(MatlabNames({longest, longest + "b"}),
              ElementsAre(longest, std::string(61, 'a') + "_2"));
}

}  // namespace
}  // namespace contact::cli
