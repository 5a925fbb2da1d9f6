#include "cli/figures/gnuplot_script.h"

#include <fmt/format.h>
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

Figure PlainFigure() {
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
  Figure figure = PlainFigure();
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
  EXPECT_THAT(Script(PlainFigure()),
              AllOf(HasSubstr("set xlabel 'time [s]'\n"), HasSubstr("set ylabel 'force [N]'\n")));
}

TEST(GnuplotScript, TextsCannotEndTheirStringOrTheirLine) {
  Figure figure = PlainFigure();
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

TEST(GnuplotScript, QuotesAreDoubledOnlyWhereGnuplotTakesThat) {
  EXPECT_EQ(GnuplotString("Newton's"), "'Newton''s'");
  EXPECT_EQ(GnuplotString("'Newton's"), "'’Newton''s'");
  EXPECT_EQ(GnuplotString("a'''b"), "'a''’’b'");
  // In pieces: clang-tidy refuses a literal that turns the direction of text.
  const std::string rightToLeft = std::string("\xe2\x80") + "\xae";
  EXPECT_EQ(GnuplotString("a\x1b[31m\u009b" + rightToLeft + "b"), "'a [31m  b'");
}

TEST(GnuplotScript, TexCommandsInTextsAreSetAsTheyAre) {
  Figure figure = PlainFigure();
  figure.panels[0].x_label = R"(\input{x} 5%)";
  const std::string script = Script(figure, GnuplotTerminal(OutputFormat::kTikz));
  EXPECT_THAT(script,
              AllOf(HasSubstr(R"(\textbackslash{}input\{x\} 5\%)"), Not(HasSubstr(R"('\in)"))));
}

TEST(GnuplotScript, OneValueAloneHasSpaceAroundIt) {
  Figure figure = PlainFigure();
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
  Figure figure = PlainFigure();
  figure.panels[0].counted_x = true;
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("set xtics 1\n"), HasSubstr("set xrange [-0.5:2.5]\n")));
  auto& curve = figure.panels[0].curves[0];
  curve.x.assign(21, 1);
  curve.y.assign(21, 1);
  EXPECT_THAT(Script(figure), HasSubstr("set xtics autofreq\n"));
}

TEST(GnuplotScript, NoteStandsOnceBelow) {
  Figure figure = PlainFigure();
  figure.panels.push_back(figure.panels[0]);
  EXPECT_THAT(Script(figure), Not(HasSubstr("o start")));
  figure.note = "o start, × end";
  EXPECT_EQ(Count(Script(figure), "set label 'o start, × end'"), 1);
  EXPECT_EQ(Count(Script(figure, kTxt), "set label 'o start, × end'"), 1);
}

TEST(GnuplotScript, DashedCurvesShareAnEntryWhenTheKeyIsFull) {
  Figure figure = PlainFigure();
  figure.panels[0].dashed = "beside";
  figure.panels[0].curves.push_back({"dashed", 0, Figure::Mark::kDashed, {1}, {1}});
  EXPECT_THAT(Script(figure), AllOf(HasSubstr("title 'dashed'"), Not(HasSubstr("'beside'"))));
  for (int i = 0; i < 9; ++i) figure.panels[0].curves.push_back(figure.panels[0].curves[0]);
  const std::string script = Script(figure);
  EXPECT_THAT(script, Not(HasSubstr("title 'dashed'")));
  EXPECT_EQ(Count(script, "title 'beside'"), 1);
}

TEST(GnuplotScript, OfManyCurvesTheKeyHasTenAndHowManyMore) {
  Figure figure = PlainFigure();
  auto& curves = figure.panels[0].curves;
  for (int i = 1; i < 100; ++i) {
    curves.push_back({fmt::format("c{}", i), i, Figure::Mark::kLine, {0, 1}, {0, 1.0 * i}});
  }
  const std::string script = Script(figure);
  EXPECT_EQ(Count(script, " title 'c"), 10);
  EXPECT_THAT(script, AllOf(HasSubstr("title 'c99'"), HasSubstr("title 'c90'"),
                            Not(HasSubstr("title 'c89'")), HasSubstr("title '90 smaller'")));
  EXPECT_EQ(Count(script, "lw 0.5 lc rgb '#c4c4c4' notitle"), 90);
  EXPECT_LT(script.find("notitle"), script.find("title 'c90'"));  // Behind the others.
  const std::string characters = Script(figure, kTxt);
  EXPECT_THAT(characters, HasSubstr("title '90 smaller: not shown'"));
  EXPECT_EQ(Count(characters, "using"), 10);
}

TEST(GnuplotScript, BandsAreOneShadeThatTheKeyNames) {
  Figure figure = PlainFigure();
  figure.panels[0].bands = {{0, 1}, {1.5, 2}};
  figure.panels[0].band_label = "in contact";
  const std::string script = Script(figure);
  EXPECT_EQ(Count(script, "fillcolor rgb '#ececec' fillstyle solid noborder\n"), 2);
  EXPECT_EQ(Count(script, "fillcolor rgb '#ececec' title 'in contact'"), 1);
  EXPECT_THAT(Script(figure, kTxt), Not(HasSubstr("in contact")));  // It draws no bands.
}

TEST(GnuplotScript, KeyHasFewerColumnsTheLongerItsTexts) {
  Figure figure = PlainFigure();
  EXPECT_THAT(Script(figure), HasSubstr("set key maxcols 9\n"));
  figure.panels[0].curves[0].label = std::string(40, 'x');
  EXPECT_THAT(Script(figure), HasSubstr("set key maxcols 2\n"));
}

TEST(GnuplotScript, EverythingInAPanelIsInItsUnits) {
  Figure figure = PlainFigure();
  Figure::Panel& panel = figure.panels[0];
  panel.curves[0].x = {0, 1e-3, 2e-3};
  panel.curves[0].y = {0, 3e4, 0};
  panel.bands = {{1e-3, 2e-3}};
  panel.labels = {{1e-3, 3e4, "peak"}};
  panel.dotted_lines = {7};
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("x_unit = 1.000000e-03\ny_unit = 1.000000e+03\n"),
                    HasSubstr("set xlabel 'time [ms]'"), HasSubstr("set ylabel 'force [kN]'"),
                    HasSubstr("$curve1 using ($1/x_unit):($2/y_unit) with"),
                    HasSubstr("from first 0.001/x_unit, graph 0 to first 0.002/x_unit, graph 1"),
                    HasSubstr("set label 'peak' at 0.001/x_unit,30000/y_unit"),
                    HasSubstr("first 7/y_unit to graph 1, first 7/y_unit")));
}

TEST(GnuplotScript, StyleSaysWhatStandsAroundTheAxes) {
  Figure figure = PlainFigure();
  figure.note = "note";
  figure.sources = {{{"job", "jobs/a"}, {"scenario_sha256", "0123"}}};
  const auto script = [&](const FigureStyle& style) {
    return Script(figure, GnuplotTerminal(OutputFormat::kSvg, 80, style));
  };
  EXPECT_THAT(script({}), AllOf(HasSubstr("title 't'"), HasSubstr("set label 'jobs/a (0123)")));
  EXPECT_THAT(script({.title = false}), Not(HasSubstr("title 't'")));
  EXPECT_THAT(script({.provenance = false}),
              AllOf(Not(HasSubstr("set label 'jobs/a")), HasSubstr("# job: jobs/a\n"),
                    HasSubstr("set label 'note'")));
  EXPECT_THAT(script({.paper = true}),
              AllOf(Not(HasSubstr("title 't'")), Not(HasSubstr("set label 'jobs/a")),
                    Not(HasSubstr("set grid")), HasSubstr("set label 'note'"),
                    HasSubstr("lc rgb '#000000' title 'a'")));
}

// In a narrow figure a line would run into the other.
TEST(GnuplotScript, NoteStandsAboveTheSourcesWhereThereIsNoRoomBeside) {
  Figure figure = PlainFigure();
  figure.note = "o start, × end of a contact cycle";
  figure.sources = {{{"job", "jobs/a"}, {"scenario_sha256", "0123456789ab"}, {"version", "1"}}};
  EXPECT_THAT(Script(figure), HasSubstr("cycle' at screen 0.01,0.015 left"));
  const GnuplotTerminal narrow(OutputFormat::kSvg, 80, {.size = FigureStyle::Size{2, 2}});
  EXPECT_THAT(Script(figure, narrow), HasSubstr("cycle' at screen 0.01,0.05 left"));
}

TEST(GnuplotScript, CharactersHaveNoFontsBandsOrUprightLabels) {
  Figure figure = PlainFigure();
  figure.panels[0].bands = {{0, 1}};
  figure.panels[0].labels.assign(5, {1, 1, "label"});
  EXPECT_THAT(Script(figure),
              AllOf(HasSubstr("rotate by 90"), HasSubstr("rectangle"), HasSubstr(" font ")));
  EXPECT_THAT(Script(figure, kTxt),
              AllOf(Not(HasSubstr("rotate by 90")), Not(HasSubstr("rectangle")),
                    Not(HasSubstr(" font ")), HasSubstr("set terminal dumb")));
}

TEST(GnuplotScript, LongCurvesAreThinnedAndKeepTheirPeak) {
  Figure figure = PlainFigure();
  auto& curve = figure.panels[0].curves[0];
  curve.x.clear();
  curve.y.assign(100'000, 0);
  for (int i = 0; i < 100'000; ++i) curve.x.push_back(i);
  curve.y[54'321] = 7;
  const std::string script = Script(figure);
  EXPECT_LT(std::ranges::count(script, '\n'), 4'100);
  EXPECT_THAT(script, HasSubstr("\n54321 7\n"));
}

TEST(GnuplotScript, ManyLongCurvesHaveFewerPointsEach) {
  Figure figure = PlainFigure();
  auto& curves = figure.panels[0].curves;
  for (int i = 0; i < 10'000; ++i) {
    curves[0].x.push_back(i);
    curves[0].y.push_back(i % 7);
  }
  while (curves.size() < 200) curves.push_back(curves[0]);
  EXPECT_LT(std::ranges::count(Script(figure), '\n'), 110'000);
}

TEST(GnuplotTerminal, HasTheSizeAndFontOfTheStyle) {
  const FigureStyle style{.size = FigureStyle::Size{4, 3}, .font = {"Times", 9}};
  const auto terminal = [&](OutputFormat format) {
    return GnuplotTerminal(format, 80, style).Terminal(5);
  };
  EXPECT_THAT(terminal(OutputFormat::kSvg),
              AllOf(HasSubstr("size 400,300"), HasSubstr("font 'Times,12.5'")));
  EXPECT_THAT(terminal(OutputFormat::kPng),
              AllOf(HasSubstr("size 800,600"), HasSubstr("font 'Times,12.5'")));
  EXPECT_THAT(terminal(OutputFormat::kPdf),
              AllOf(HasSubstr("size 4in,3in"), HasSubstr("font 'Times,9'")));
  EXPECT_THAT(terminal(OutputFormat::kTikz), HasSubstr("size 4in,3in"));
  EXPECT_THAT(terminal(OutputFormat::kText), HasSubstr("size 40,14"));
}

TEST(GnuplotTerminal, PartsOfAFigureScaleWithItsFont) {
  const GnuplotTerminal small(OutputFormat::kPdf, 80, {.font = {"", 5.5}});
  EXPECT_EQ(small.Font(10), " font ',5'");
  EXPECT_EQ(kSvg.Font(10), " font ',10'");
}

TEST(GnuplotTerminal, FigureForPaperIsAsWideAsAColumn) {
  const GnuplotTerminal paper(OutputFormat::kPdf, 80, {.paper = true});
  EXPECT_THAT(paper.Terminal(5), AllOf(HasSubstr("size 3.4in,2.55in"), HasSubstr("'Times,8'")));
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
