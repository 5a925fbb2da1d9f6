#include "cli/figures/gnuplot_script.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const GnuplotTerminal kSvg(OutputFormat::kSvg);
const GnuplotTerminal kTxt(OutputFormat::kText);

Figure Plain() {
  return {.title = "t",
          .panels = {{.x_label = "time [s]",
                      .y_label = "force [N]",
                      .curves = {{"a", 0, Figure::Mark::kLine, {0, 1, 2}, {0, 0.5, -1e-300}}}}}};
}

std::string Script(const Figure& figure, const GnuplotTerminal& terminal = kSvg) {
  return GnuplotScript(figure, terminal, "out.svg");
}

std::ptrdiff_t Count(const std::string& text, const std::string& word) {
  std::ptrdiff_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(GnuplotScript, EveryCurveThatIsPlottedHasItsDataBlock) {
  Figure figure = Plain();
  figure.panels.push_back(figure.panels[0]);
  figure.panels[1].curves.push_back({"b", 1, Figure::Mark::kDashed, {1}, {2}});
  const std::string script = Script(figure);
  EXPECT_THAT(script, HasSubstr("$curve1 << end\n0 0\n1 0.5\n2 -1e-300\nend\n"));
  EXPECT_THAT(script, HasSubstr("$curve3 << end\n1 2\nend\n"));
  for (const char* curve : {"$curve1", "$curve2", "$curve3"}) {
    EXPECT_EQ(Count(script, curve), 2) << curve;  // Once as data, once after `plot`.
  }
  EXPECT_EQ(Count(script, "$curve4"), 0);
}

TEST(GnuplotScript, AxesAreLabelledWithQuantityAndUnit) {
  EXPECT_THAT(Script(Plain()),
              AllOf(HasSubstr("set xlabel 'time [s]'\n"), HasSubstr("set ylabel 'force [N]'\n")));
}

TEST(GnuplotScript, TextsCannotEndTheirStringOrTheirLine) {
  Figure figure = Plain();
  const std::string nasty = "it's '\nset output 'pwned";
  figure.title = nasty;
  figure.panels[0].x_label = nasty;
  figure.panels[0].curves[0].label = nasty;
  figure.panels[0].labels.push_back({1, 1, nasty});
  figure.sources = {{{"title", nasty}}};
  std::istringstream lines(Script(figure));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_FALSE(line.starts_with("set output 'pwned")) << line;
    if (!line.starts_with("#")) {
      EXPECT_EQ(std::ranges::count(line, '\'') % 2, 0) << line;
    }
  }
}

TEST(GnuplotScript, TexCommandsInTextsAreSetAsTheyAre) {
  Figure figure = Plain();
  figure.panels[0].x_label = R"(\input{x} 5%)";
  const std::string script = Script(figure, GnuplotTerminal(OutputFormat::kTikz));
  EXPECT_THAT(script,
              AllOf(HasSubstr(R"(\textbackslash{}input\{x\} 5\%)"), Not(HasSubstr(R"('\in)"))));
}

TEST(GnuplotScript, OneValueAloneHasSpaceAroundIt) {
  Figure figure = Plain();
  figure.panels[0].curves[0].y = {4, 4, 4};
  EXPECT_THAT(Script(figure), HasSubstr("set yrange [2:6]\n"));
  figure.panels[0].curves[0].y = {0, 0, 0};
  EXPECT_THAT(Script(figure), HasSubstr("set yrange [-1:1]\n"));
  figure.panels[0].log_y = true;
  figure.panels[0].curves[0].y = {10, 10, 10};
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("set yrange [1:100]\n"), HasSubstr("\nset logscale y\n")));
}

TEST(GnuplotScript, CountedAxesHaveATicForEachWholeNumberWhileTheyAreFew) {
  Figure figure = Plain();
  figure.panels[0].counted_x = true;
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("set xtics 1\n"), HasSubstr("set xrange [-0.5:2.5]\n")));
  auto& curve = figure.panels[0].curves[0];
  curve.x.assign(21, 1);
  curve.y.assign(21, 1);
  EXPECT_THAT(Script(figure), HasSubstr("set xtics autofreq\n"));
}

TEST(GnuplotScript, MarksAreExplainedOnceUnlessTheKeyNamesThem) {
  Figure figure = Plain();
  EXPECT_THAT(Script(figure), Not(HasSubstr("o start")));
  figure.panels[0].curves.push_back({"", 0, Figure::Mark::kStart, {1}, {1}});
  EXPECT_EQ(Count(Script(figure), "o start, × end"), 1);
  figure.panels[0].curves.back().label = "start";
  EXPECT_THAT(Script(figure), Not(HasSubstr("o start")));
}

TEST(GnuplotScript, DashedCurvesLeaveTheKeyWhenItIsFull) {
  Figure figure = Plain();
  figure.panels[0].curves.push_back({"dashed", 0, Figure::Mark::kDashed, {1}, {1}});
  EXPECT_THAT(Script(figure), HasSubstr("title 'dashed'"));
  for (int i = 0; i < 7; ++i) figure.panels[0].curves.push_back(figure.panels[0].curves[0]);
  EXPECT_THAT(Script(figure), Not(HasSubstr("title 'dashed'")));
}

TEST(GnuplotScript, CharactersHaveNoFontsBandsOrUprightLabels) {
  Figure figure = Plain();
  figure.panels[0].bands = {{0, 1, 0}};
  figure.panels[0].labels.assign(5, {1, 1, "label"});
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("rotate by 90"), HasSubstr("rectangle"), HasSubstr(" font ")));
  EXPECT_THAT(Script(figure, kTxt),
              AllOf(Not(HasSubstr("rotate by 90")), Not(HasSubstr("rectangle")),
                    Not(HasSubstr(" font ")), HasSubstr("set terminal dumb")));
}

TEST(GnuplotScript, ManyBandsAreFainterThanFew) {
  Figure figure = Plain();
  figure.panels[0].bands = {{0, 1, 0}};
  EXPECT_THAT(Script(figure), HasSubstr("transparent solid 0.12 "));
  for (int i = 1; i < 10; ++i) figure.panels[0].bands.push_back({0, 1, i});
  EXPECT_THAT(Script(figure), HasSubstr("transparent solid 0.04 "));
}

TEST(GnuplotScript, LongCurvesAreThinnedAndKeepTheirPeak) {
  Figure figure = Plain();
  auto& curve = figure.panels[0].curves[0];
  curve.x.clear();
  curve.y.assign(100'000, 0);
  for (int i = 0; i < 100'000; ++i) curve.x.push_back(i);
  curve.y[54'321] = 7;
  const std::string script = Script(figure);
  EXPECT_LT(std::ranges::count(script, '\n'), 4'100);
  EXPECT_THAT(script, HasSubstr("\n54321 7\n"));
}

TEST(GnuplotTerminal, PicksTheTerminalOfTheFormat) {
  EXPECT_THAT(kSvg.Terminal(5), HasSubstr("svg noenhanced size 800,500"));
  EXPECT_THAT(GnuplotTerminal(OutputFormat::kPng).Terminal(5), HasSubstr("size 1600,1000"));
  EXPECT_THAT(GnuplotTerminal(OutputFormat::kPdf).Terminal(7), HasSubstr("size 8in,7in"));
  EXPECT_THAT(GnuplotTerminal(OutputFormat::kTikz).Terminal(4), HasSubstr("size 6in,3in"));
  EXPECT_THAT(GnuplotTerminal(OutputFormat::kText, 60).Terminal(5), HasSubstr("size 60,24"));
}

TEST(GnuplotTerminal, QuotesForGnuplotAndForTex) {
  EXPECT_EQ(kSvg.Text("it's 5%"), "'it''s 5%'");
  EXPECT_EQ(GnuplotTerminal(OutputFormat::kTikz).Text("it's 5%"), "'it''s 5\\%'");
  EXPECT_EQ(kTxt.Font(9), "");
}

}  // namespace
}  // namespace contact::cli
