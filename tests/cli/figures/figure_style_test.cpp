#include "cli/figures/form/figure_style.h"

#include <gtest/gtest.h>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

TEST(ParseSize, ReadsInchesCentimetresAndMillimetres) {
  EXPECT_DOUBLE_EQ(ParseSize("3.4x2.5").width, 3.4);
  EXPECT_DOUBLE_EQ(ParseSize("3.4x2.5in").height, 2.5);
  EXPECT_NEAR(ParseSize("85x60mm").width, 85 / 25.4, 1e-12);
  EXPECT_NEAR(ParseSize("8.5x6cm").height, 6 / 2.54, 1e-12);
}

TEST(ParseSize, RefusesWhatIsNoSize) {
  for (const char* text : {"", "8", "8x", "x5", "8x5px", "8 x 5", "-8x5", "8x5x3", "0.5x5", "101x5",
                           "nanx5", "1e1x5", "8in x 5in"}) {
    EXPECT_THROW(ParseSize(text), Failure) << text;
  }
}

TEST(ParseFont, EitherPartMayBeLeftOut) {
  EXPECT_EQ(ParseFont("Times,9").family, "Times");
  EXPECT_EQ(ParseFont("Times,9").points, 9);
  EXPECT_EQ(ParseFont("DejaVu Sans").family, "DejaVu Sans");
  EXPECT_EQ(ParseFont("DejaVu Sans").points, 0);
  EXPECT_EQ(ParseFont("8.5").family, "");
  EXPECT_EQ(ParseFont(",8.5").points, 8.5);
}

// It stands in a script of gnuplot.
TEST(ParseFont, RefusesWhatIsNoFont) {
  for (const char* text : {"", "Times,", "Times,9,9", "Times,1", "Times,-9", "x'\nset", "a\"b",
                           "{/Bold x}", "Times,9pt"}) {
    EXPECT_THROW(ParseFont(text), Failure) << text;
  }
}

}  // namespace
}  // namespace contact::cli
