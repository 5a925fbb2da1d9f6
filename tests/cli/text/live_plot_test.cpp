#include "cli/text/live_plot.h"

#include <gmock/gmock.h>

#include "cli/base/dot_canvas.h"
#include "cli/base/style.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<SampleColumn> Ramp() {
  return {{"time", "time", "s", {0, 1, 2, 3}}, {"B.velocity", "velocity", "m/s", {0, 1, 2, 3}}};
}

TEST(DotCanvas, HasEightDotsInACharacterOfBraille) {
  DotCanvas canvas(2, 1, true);
  EXPECT_EQ(canvas.width(), 4);
  EXPECT_EQ(canvas.height(), 4);
  canvas.Line(0, 0, 0, 3);
  canvas.Line(3, 3, 3, 3);
  EXPECT_THAT(canvas.Rows(), ElementsAre("⡇⢀"));
}

TEST(DotCanvas, DrawsADiagonalInAscii) {
  DotCanvas canvas(3, 3, false);
  canvas.Line(0, 2, 2, 0);
  EXPECT_THAT(canvas.Rows(), ElementsAre("  *", " * ", "*  "));
}

TEST(DotCanvas, LeavesOutWhatLiesOutside) {
  DotCanvas canvas(1, 1, false);
  canvas.Line(-5, 0, 5, 0);
  EXPECT_THAT(canvas.Rows(), ElementsAre("*"));
}

TEST(RenderLivePlot, FillsTheTerminalAndNoMore) {
  for (const bool braille : {true, false}) {
    const auto lines = RenderLivePlot(Ramp(), {"B.velocity"}, 9, {20, 6}, braille);
    ASSERT_THAT(lines, SizeIs(6));
    for (const std::string& line : lines) EXPECT_LE(Width(line), 20);
    EXPECT_THAT(lines.front(), HasSubstr("B.velocity [m/s]"));
    EXPECT_EQ(lines.back(), "t = 3 s");
  }
  EXPECT_THAT(RenderLivePlot(Ramp(), {"B.velocity"}, 9, {5, 2}, true), SizeIs(2));
}

TEST(RenderLivePlot, ShowsAReplayUpToItsTimeOnTheAxesOfAll) {
  const auto lines = RenderLivePlot(Ramp(), {"B.velocity"}, 1.5, {4, 6}, false);
  EXPECT_EQ(lines[1], "    ");  // The top of the ramp is not reached.
  EXPECT_EQ(lines[4], "*   ");
  EXPECT_EQ(lines.back(), "t = ");
}

TEST(RenderLivePlot, SaysThatNothingHasCome) {
  EXPECT_THAT(RenderLivePlot({}, {"B.velocity"}, 0, {40, 6}, true),
              ElementsAre("B.velocity  nothing yet"));
}

}  // namespace
}  // namespace contact::cli
