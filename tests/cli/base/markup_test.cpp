#include <gmock/gmock.h>

#include "cli/base/escape.h"
#include "cli/base/html.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Html, TextCannotBecomeMarkup) {
  EXPECT_EQ(HtmlText("<b a=\"1\">&</b>"), "&lt;b a=&quot;1&quot;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(HtmlText("\u03b5 = 0.7"), "\u03b5 = 0.7");
  EXPECT_EQ(HtmlText("a\x1b[2J\u009b\nb"), "a [2J \nb");
  EXPECT_THAT(HtmlTable({"<h>"}, {{{"<c>"}}}), Not(HasSubstr("<c>")));
  EXPECT_THAT(HtmlPage("<t>", ""), Not(HasSubstr("<t>")));
}

// Every text can be read back, so nothing is lost or read twice.
TEST(Html, EscapedTextIsTheTextAgainForABrowser) {
  const std::pair<std::string, char> entities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&amp;", '&'}};
  const std::string alphabet = "<>&\";am";
  for (int seed = 0; seed < 4096; ++seed) {
    std::string text;
    for (int digits = seed; digits > 0; digits /= 8) {
      text += alphabet[static_cast<std::size_t>(digits % 7)];
    }
    const std::string escaped = HtmlText(text);
    std::string read;
    for (std::size_t i = 0; i < escaped.size();) {
      ASSERT_THAT(escaped.substr(i, 1), testing::AnyOf("&", ";", "a", "m")) << escaped;
      std::size_t size = 1;
      char character = escaped[i];
      for (const auto& [entity, meaning] : entities) {
        if (escaped.compare(i, entity.size(), entity) != 0) continue;
        size = entity.size();
        character = meaning;
      }
      ASSERT_TRUE(escaped[i] != '&' || size > 1) << escaped;
      read += character;
      i += size;
    }
    ASSERT_EQ(read, text);
  }
}

TEST(Html, ColumnsOfNumbersStandToTheRight) {
  EXPECT_EQ(HtmlTable({"name", "value"}, {{{"a", "-1"}}, {{"b", ""}}, {{"c", "0.5"}, true}}),
            "<table>\n<tr><th>name</th><th class=\"n\">value</th></tr>\n"
            "<tr><td>a</td><td class=\"n\">-1</td></tr>\n"
            "<tr><td>b</td><td class=\"n\"></td></tr>\n"
            "<tr class=\"d\"><td>c</td><td class=\"n\">0.5</td></tr>\n</table>\n");
}

TEST(Html, APageNeedsNothingFromElsewhere) {
  const std::string page = HtmlPage("Run", "<p>body</p>\n");
  EXPECT_THAT(page, HasSubstr("<h1>Run</h1>\n<p>body</p>\n</body>"));
  for (const char* elsewhere : {"http", "src=", "<script", "<link", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(elsewhere)));
  }
}

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
