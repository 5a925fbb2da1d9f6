#include "cli/text/live_plot.h"

#include <gmock/gmock.h>

#include "cli/base/style.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<SampleColumn> Ramp() {
  return {{"time", "time", "s", {0, 1, 2, 3}}, {"B.velocity", "velocity", "m/s", {0, 1, 2, 3}}};
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
