#include <gmock/gmock.h>

#include "cli/base/escape.h"

namespace contact::cli {
namespace {

TEST(Latex, EverySpecialCharacterIsEscaped) {
  for (const char special : std::string("&%$#_{}")) {
    EXPECT_EQ(LatexText(std::string(1, special)), std::string("\\") + special);
  }
  for (const char* special : {"\\", "^", "~", "<", ">", "|"}) {
    EXPECT_THAT(LatexText(special), testing::MatchesRegex("\\\\text[a-z]+\\{\\}")) << special;
  }
}

TEST(Latex, OtherTextStaysAsItIs) {
  EXPECT_EQ(LatexText("St\u00f6\u00dfe 0.7 (a-b)"), "St\u00f6\u00dfe 0.7 (a-b)");
  EXPECT_EQ(LatexText("\u03bc\u00d7\u03b4\u00b2"), "$\\mu$$\\times$$\\delta$$^2$");
}

}  // namespace
}  // namespace contact::cli
