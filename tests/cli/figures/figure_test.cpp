#include "cli/figures/figure.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "cli/base/failure.h"
#include "cli/figures/curve_style.h"
#include "cli/figures/draw.h"
#include "cli/figures/overlay.h"
#include "cli/figures/run/sampling.h"
#include "testing/sample_run.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;

Figure OfCurve(std::vector<double> y) {
  std::vector<double> x;
  for (std::size_t i = 0; i < y.size(); ++i) x.push_back(static_cast<double>(i));
  Figure figure{.panels = {{.x_label = "time [s]", .y_label = "force [N]"}}};
  figure.panels[0].curves = {{"a", 0, Figure::Mark::kLine, std::move(x), std::move(y)}};
  return figure;
}

TEST(Thin, LeavesShortCurvesAsTheyAre) {
  Figure figure = OfCurve({3, 1, 2});
  Thin(3, &figure);
  EXPECT_THAT(figure.panels[0].curves[0].y, ElementsAre(3, 1, 2));
}

TEST(Thin, KeepsEndsAndExtremesInOrder) {
  std::vector<double> y(1000, 0);
  y[123] = 5;
  y[877] = -5;
  Figure figure = OfCurve(y);
  Thin(40, &figure);
  const auto& curve = figure.panels[0].curves[0];
  EXPECT_LE(curve.x.size(), 40U);
  EXPECT_EQ(curve.x.size(), curve.y.size());
  EXPECT_EQ(curve.x.front(), 0);
  EXPECT_EQ(curve.x.back(), 999);
  EXPECT_TRUE(std::ranges::is_sorted(curve.x));
  EXPECT_EQ(std::ranges::max(curve.y), 5);
  EXPECT_EQ(std::ranges::min(curve.y), -5);
}

TEST(FigureCsv, HasEveryPointBelowTheNamesOfTheAxes) {
  Figure figure = OfCurve({0.1, 1e-300});
  figure.panels[0].curves.push_back({"a ends", 0, Figure::Mark::kEnd, {2}, {3}});
  EXPECT_EQ(FigureCsv(figure), "curve,time [s],force [N]\na,0,0.1\na,1,1e-300\na ends,2,3\n");
}

// A figure of as many curves as there are peaks, with a mark each; the curve of each goes from its
// height to the next.
Figure OfPeaks(const std::vector<double>& peaks) {
  Figure figure{.panels = {{.x_label = "time [s]", .y_label = "force [N]"}}};
  auto& curves = figure.panels[0].curves;
  for (const double peak : peaks) {
    const int colour = static_cast<int>(curves.size() / 2);
    const std::string name = fmt::format("c{}", colour);
    curves.push_back({name, colour, Figure::Mark::kLine, {0, 1}, {0, peak}});
    curves.push_back({name + " ends", colour, Figure::Mark::kEnd, {1}, {peak}, false});
  }
  return figure;
}

// The labels of the curves that are in the key.
std::vector<std::string> Keyed(const Figure::Panel& panel) {
  std::vector<std::string> labels;
  for (const Figure::Curve& curve : panel.curves) {
    if (curve.keyed && !curve.label.empty()) labels.push_back(curve.label);
  }
  return labels;
}

TEST(KeepLargest, LeavesTheKeyToTheLargestPeaksInTheirOrder) {
  Figure figure = OfPeaks({1, -7, 5, 2, 9});
  figure.most_colours = 3;
  KeepLargest(&figure);
  EXPECT_EQ(figure.crowd, 2U);
  EXPECT_THAT(Keyed(figure.panels[0]), ElementsAre("c1", "c2", "c4"));
  std::vector<int> colours;
  std::vector<std::string> faint;
  for (const Figure::Curve& curve : figure.panels[0].curves) {
    if (IsFaint(curve)) {
      faint.push_back(curve.label);
    } else if (curve.mark == Figure::Mark::kLine) {
      colours.push_back(curve.colour);
    }
  }
  EXPECT_THAT(colours, ElementsAre(0, 1, 2));   // No two of them share a colour.
  EXPECT_THAT(faint, ElementsAre("c0", "c3"));  // Without their marks.
}

TEST(KeepLargest, ChangesNothingWhereAllHaveAColour) {
  Figure figure = OfPeaks({1, 2, 3});
  KeepLargest(&figure);
  EXPECT_EQ(figure.crowd, 0U);
  EXPECT_THAT(figure.panels[0].curves, SizeIs(6));
}

TEST(KeepLargest, AsksTheLastPanelThatHasTheCurve) {
  Figure figure = OfPeaks({3, 2, 1});
  figure.panels.push_back(OfPeaks({1, 2, 3}).panels[0]);
  figure.most_colours = 1;
  KeepLargest(&figure);
  for (const Figure::Panel& panel : figure.panels) EXPECT_THAT(Keyed(panel), ElementsAre("c2"));
}

TEST(KeepLargest, SpansMayCountInsteadOfHeights) {
  Figure figure = OfPeaks({1, 1});
  figure.panels[0].curves[0].y = {100, 101};  // High up, but it moves less.
  figure.panels[0].curves[2].y = {0, 50};
  figure.most_colours = 1;
  Figure ranked = figure;
  ranked.panels[0].ranked_by_span = true;
  KeepLargest(&figure);
  KeepLargest(&ranked);
  EXPECT_THAT(Keyed(figure.panels[0]), ElementsAre("c0"));
  EXPECT_THAT(Keyed(ranked.panels[0]), ElementsAre("c1"));
}

TEST(KeepLargest, OfAPanelOfMarksAloneTheOthersAreDots) {
  Figure figure = OfPeaks({1, 2});
  auto& curves = figure.panels[0].curves;
  std::erase_if(curves, [](const auto& curve) { return curve.mark == Figure::Mark::kLine; });
  figure.most_colours = 1;
  KeepLargest(&figure);
  ASSERT_THAT(curves, SizeIs(2));
  EXPECT_EQ(curves[0].mark, Figure::Mark::kFaintDots);
  EXPECT_EQ(curves[1].mark, Figure::Mark::kEnd);
}

TEST(CurveStyle, PaperHasNoColoursAndTellsTenCurvesApart) {
  std::set<std::string> styles;
  for (int colour = 0; colour < 10; ++colour) {
    const std::string style = PaperStyle({.colour = colour});
    EXPECT_THAT(style, testing::AnyOf(HasSubstr("'#000000'"), HasSubstr("'#888888'")));
    styles.insert(style);
  }
  EXPECT_THAT(styles, SizeIs(10));
}

TEST(CurveStyle, CurvesOfTheSameColourHaveOtherDashes) {
  const Figure::Curve first{.colour = 1};
  const Figure::Curve again{.colour = 8};
  EXPECT_EQ(PaletteColour(1), PaletteColour(8));
  EXPECT_NE(ColouredStyle(first), ColouredStyle(again));
}

TEST(CurveStyle, SolidAndDashedCurvesHaveOtherCharacters) {
  for (int colour = 0; colour < 7; ++colour) {
    EXPECT_NE(CharacterStyle({.colour = colour, .mark = Figure::Mark::kLine}),
              CharacterStyle({.colour = colour, .mark = Figure::Mark::kDashed}));
  }
}

TEST(FigureFormat, IsThatOfTheFlagElseOfTheEndingElseSvg) {
  Settings settings;
  EXPECT_EQ(FigureFormat("a.pdf", settings), OutputFormat::kPdf);
  EXPECT_EQ(FigureFormat("a.tex", settings), OutputFormat::kTikz);
  EXPECT_EQ(FigureFormat("a", settings), OutputFormat::kSvg);
  EXPECT_THROW(FigureFormat("a.jpg", settings), Failure);
  EXPECT_EQ(FigurePath("", "force", settings), "force.svg");
  settings.SetOutput("tikz");
  EXPECT_EQ(FigureFormat("a.pdf", settings), OutputFormat::kTikz);
  EXPECT_EQ(FigurePath("", "force", settings), "force.tex");
  settings.SetOutput("netcdf");
  EXPECT_THROW(FigureFormat("a.pdf", settings), Failure);
}

TEST(InlineSvg, HasNeitherDeclarationsNorTooltip) {
  EXPECT_EQ(InlineSvg("<?xml version=\"1.0\"?>\n<svg a=\"1\" xmlns=\"http://www.w3.org/2000/svg\">"
                      "<title>t</title><g/></svg>"),
            "<svg a=\"1\" ><g/></svg>");
  EXPECT_EQ(InlineSvg("no figure"), "");
}

TEST(Overlay, NamesRunsByTheOneParameterInWhichTheyDiffer) {
  Recording other = SampleRun();
  other.job.mutable_scenario()->mutable_contacts(0)->set_restitution(0.5);
  const Figure figure = OverlayFigure({SampleRun(), other}, {});
  EXPECT_THAT(figure.title, HasSubstr(": contacts[0].restitution"));
  ASSERT_THAT(figure.panels, SizeIs(2));  // A panel for each contact.
  EXPECT_EQ(figure.panels[0].y_label, "A-B.contact_force [N]");
  EXPECT_THAT(figure.panels[0].curves, ElementsAre(Field(&Figure::Curve::label, "0.8"),
                                                   Field(&Figure::Curve::label, "0.5")));
  EXPECT_THAT(figure.panels[1].curves[0].label, "");  // The key stands once.
  EXPECT_THAT(figure.sources, SizeIs(2));
}

TEST(Overlay, NamesRunsByTheirJobWhereTheyDifferInMore) {
  Recording other = SampleRun();
  other.job.set_name("jobs/other");
  other.job.mutable_scenario()->mutable_contacts(0)->set_restitution(0.5);
  other.job.mutable_scenario()->mutable_bodies(0)->set_mass_kg(4);
  const Figure figure = OverlayFigure({SampleRun(), other}, {"A.velocity"});
  EXPECT_EQ(figure.panels.at(0).curves.at(1).label,
            "jobs/other, bodies[0].mass_kg = 4, contacts[0].restitution = 0.5");
  EXPECT_THROW(OverlayFigure({other}, {"C.velocity"}), Failure);
}

TEST(CoarseSampling, TellsTheCommandThatRecordsMore) {
  Recording run = SampleRun();
  EXPECT_EQ(CoarseSampling(run), "");
  run.job.mutable_cycles(0)->set_end_time_s(0.05);
  EXPECT_EQ(CoarseSampling(run),
            "1 contact cycle has fewer than 10 samples, too few to show. For more:\n"
            "  contactctl run --like jobs/sample --set output.samples_per_contact=100");
  run.job.mutable_cycles(0)->set_end(v1::Cycle::RUN_END);  // Cut off: its length says nothing.
  EXPECT_EQ(CoarseSampling(run), "");
}

}  // namespace
}  // namespace contact::cli
