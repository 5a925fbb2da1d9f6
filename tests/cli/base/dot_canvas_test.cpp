#include "cli/base/dot_canvas.h"

#include <gmock/gmock.h>

#include "cli/base/style.h"

namespace contact::cli {
namespace {

using testing::Each;
using testing::ElementsAre;

int Dots(const DotCanvas& canvas) {
  int dots = 0;
  for (const std::string& row : canvas.Rows()) {
    dots += static_cast<int>(std::ranges::count(row, '*'));
  }
  return dots;
}

TEST(DotCanvas, ALineJoinsItsEndsWithoutGaps) {
  DotCanvas canvas(5, 3, false);
  canvas.Line(0, 0, 4, 2);
  EXPECT_THAT(canvas.Rows(), ElementsAre("*    ", " **  ", "   **"));
}

TEST(DotCanvas, DownIsDownTheScreen) {
  DotCanvas canvas(3, 3, false);
  canvas.Line(0, 2, 2, 0);
  EXPECT_THAT(canvas.Rows(), ElementsAre("  *", " * ", "*  "));
}

TEST(DotCanvas, ALineIsTheSameInBothDirectionsUpToItsSteps) {
  for (int x = 0; x < 8; ++x) {
    DotCanvas there(8, 8, false);
    DotCanvas back(8, 8, false);
    there.Line(0, 7, x, 0);
    back.Line(x, 0, 0, 7);
    EXPECT_EQ(Dots(there), 8) << x;
    EXPECT_EQ(Dots(back), 8) << x;
  }
}

TEST(DotCanvas, BrailleHasEightDotsInACharacter) {
  DotCanvas canvas(2, 1, true);
  EXPECT_EQ(canvas.width(), 4);
  EXPECT_EQ(canvas.height(), 4);
  canvas.Line(0, 0, 0, 3);
  canvas.Line(3, 3, 3, 3);
  EXPECT_THAT(canvas.Rows(), ElementsAre("\u2847\u2880"));
}

TEST(DotCanvas, EveryRowIsAsWideAsTheCanvas) {
  for (const bool braille : {false, true}) {
    DotCanvas canvas(7, 4, braille);
    canvas.Line(-100, 5, 100, -3);
    ASSERT_EQ(canvas.Rows().size(), 4U);
    for (const std::string& row : canvas.Rows()) EXPECT_EQ(Width(row), 7);
  }
}

TEST(DotCanvas, WhatLiesOutsideIsLeftOut) {
  DotCanvas canvas(3, 2, false);
  canvas.Line(-5, -5, -1, -1);
  canvas.Line(3, 0, 9, 9);
  EXPECT_THAT(canvas.Rows(), Each("   "));
  canvas.Line(-10, 1, 10, 1);
  EXPECT_THAT(canvas.Rows(), ElementsAre("   ", "***"));
}

}  // namespace
}  // namespace contact::cli
