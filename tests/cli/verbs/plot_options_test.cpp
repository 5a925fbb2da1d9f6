#include "cli/verbs/plot_options.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;

// The options that a line of flags gives.
PlotOptions Parsed(const std::string& flags) {
  CommandLine line("A program.");
  PlotOptions options;
  options.AddTo(line, *line.app().add_subcommand("plot"));
  line.app().parse("plot " + flags);
  return options;
}

Figure OneCurve(std::vector<double> y) {
  std::vector<double> x(y.size());
  return {.panels = {{.x_label = "time [s]",
                      .y_label = "force [N]",
                      .lowest_y = 0,
                      .curves = {{"a", 0, Figure::Mark::kLine, std::move(x), std::move(y)}}}}};
}

TEST(PlotOptions, FlagsSayWhatIsShown) {
  const FigurePart part = Parsed("--contacts A-B,W --from 1e-3 --to 2").part();
  EXPECT_THAT(part.contacts, ElementsAre("A-B", "W"));
  EXPECT_EQ(part.from, 1e-3);
  EXPECT_EQ(part.to, 2);
}

TEST(PlotOptions, FlagsSayHowItLooks) {
  const FigureStyle plain = Parsed("").Look();
  EXPECT_TRUE(plain.title && plain.provenance && !plain.paper && !plain.size);
  const FigureStyle style =
      Parsed("--no-title --no-provenance --style paper --size 4x3 --font Times,9 --unit ms,kN")
          .Look();
  EXPECT_TRUE(!style.title && !style.provenance && style.paper);
  EXPECT_EQ(style.size->width, 4);
  EXPECT_EQ(style.font.points, 9);
  EXPECT_THAT(style.units, ElementsAre("ms", "kN"));
  EXPECT_THROW(Parsed("--size 4").Look(), Failure);
}

TEST(PlotOptions, UnitThatNoAxisCanHaveIsRefused) {
  Figure figure = OneCurve({1});
  Parsed("--unit ms,kN").Adapt(&figure);
  EXPECT_THROW(Parsed("--unit mm").Adapt(&figure), Failure);
}

TEST(PlotOptions, LogarithmicAxisNeedsAValueAboveZero) {
  Figure figure = OneCurve({-1, 0, 2});
  Parsed("").Adapt(&figure);
  EXPECT_FALSE(figure.panels[0].log_y);
  Parsed("--log").Adapt(&figure);
  EXPECT_TRUE(figure.panels[0].log_y);
  EXPECT_FALSE(figure.panels[0].lowest_y);
  figure = OneCurve({-1, 0});
  EXPECT_THROW(Parsed("--log").Adapt(&figure), Failure);
}

}  // namespace
}  // namespace contact::cli
