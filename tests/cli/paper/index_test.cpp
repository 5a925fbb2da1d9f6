#include "cli/paper/index.h"

#include <gmock/gmock.h>

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kBold[] = "<b>&";

PaperItem Item(const std::string& id, double process, double limit) {
  return {.id = id,
          .title = "What it shows",
          .numbers = {{.what = "a", .published = 1, .process = process, .limit = limit}},
          .data = {{id, {"time_s"}, {{0}, {1}}}}};
}

std::string Page(const std::vector<PaperItem>& items,
                 const std::map<std::string, std::string>& figures = {}) {
  return IndexPage(items, figures, {"contactd 1", "{}", "contactctl paper all"});
}

TEST(IndexPage, TellsOfEachItemWhetherItHolds) {
  const std::string page =
      Page({Item("good", 1, 0.1), Item("bad", 2, 0.1), Item("free", 2, kNoNumber)});
  EXPECT_THAT(page, AllOf(HasSubstr("<td>good</td><td>What it shows</td><td>holds</td>"),
                          HasSubstr("<tr class=\"d\"><td>bad</td><td>What it shows</td>"
                                    "<td>DIFFERS</td>"),
                          HasSubstr("<td>free</td><td>What it shows</td><td>shown</td>")));
}

TEST(IndexPage, EscapesTexts) {
  PaperItem item = Item("x", 1, 1);
  item.title = item.numbers[0].what = item.numbers[0].why = item.data[0].note = kBold;
  const std::string page = IndexPage({item}, {}, {kBold, kBold, kBold});
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;b&gt;&amp;"), Not(HasSubstr(kBold))));
}

TEST(IndexPage, HasTheFiguresAndLinksTheData) {
  EXPECT_THAT(Page({Item("x", 1, 1)}, {{"x", "<svg/>"}}),
              AllOf(HasSubstr("<figure><svg/></figure>"),
                    HasSubstr("<a href=\"x.csv\">x.csv</a>, 2 rows"), Not(HasSubstr("not drawn"))));
  EXPECT_THAT(Page({Item("x", 1, 1)}), HasSubstr("Figures were not drawn"));
}

TEST(IndexPage, LeavesOutColumnsInWhichNothingStands) {
  const std::string page = Page({Item("x", 1, 0.1)});
  EXPECT_THAT(page, AllOf(HasSubstr(">Published</th>"), HasSubstr(">Limit</th>"),
                          Not(HasSubstr(">Converged</th>")), Not(HasSubstr(">Why</th>"))));
}

TEST(IndexPage, TellsTheCommandThatMakesItAgain) {
  EXPECT_THAT(Page({}), AllOf(HasSubstr("<pre>contactctl paper all</pre>"),
                              HasSubstr("Made by contactd 1.")));
}

}  // namespace
}  // namespace contact::cli
