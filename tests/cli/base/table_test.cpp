#include "cli/base/table.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

Table Example() {
  Table table({{"NAME"}, {"μ", true}, {"END", false, 2}, {"t [s]", true, 1}});
  table.Add({std::string("B1-B2"), std::string("2.26e8"), std::string("SEPARATION"),
             std::string("0.0021")});
  table.Add({std::string("δ"), std::string("1"), std::string("-"), std::string("3")});
  return table;
}

TEST(Table, ColumnsAreAsWideAsTheirWidestCellInCharacters) {
  EXPECT_EQ(Example().Text({}),
            "NAME        μ  END          t [s]\n"
            "B1-B2  2.26e8  SEPARATION  0.0021\n"
            "δ           1  -                3\n");
}

TEST(Table, NarrowTerminalLosesTheColumnsToSpareFirst) {
  EXPECT_EQ(Example().Text({.width = 32}),
            "NAME        μ   t [s]\n"
            "B1-B2  2.26e8  0.0021\n"
            "δ           1       3\n");
}

TEST(Table, SomeColumnsAreOfWideTablesOnly) {
  Table table({{"NAME"}, {"WORK", true, Table::kOnlyWide}});
  table.Add({std::string("B1-B2"), std::string("2.5")});
  EXPECT_EQ(table.Text({}), "NAME\nB1-B2\n");
  EXPECT_EQ(table.Text({.width = 6}), "NAME\nB1-B2\n");
  EXPECT_EQ(table.Text({.wide = true}), "NAME   WORK\nB1-B2   2.5\n");
}

TEST(Table, ColumnsThatAreAskedForAreShownInTheirOrderHoweverNarrowTheTerminal) {
  EXPECT_EQ(Example().Text({.columns = {"t", "end", "NAME"}}),
            " t [s]  END         NAME\n"
            "0.0021  SEPARATION  B1-B2\n"
            "     3  -           δ\n");
  EXPECT_EQ(Example().Text({.width = 25, .columns = {"t", "end", "NAME"}}),
            Example().Text({.columns = {"t", "end", "NAME"}}));
  Table table({{"NAME"}, {"W_c [J]", true, Table::kOnlyWide, "work"}});
  table.Add({std::string("B1-B2"), std::string("2.5")});
  EXPECT_EQ(table.Text({.columns = {"work"}}), "W_c [J]\n    2.5\n");
}

TEST(Table, CsvHasNamesWithoutUnitsAndNothingForADash) {
  EXPECT_EQ(Example().Csv(),
            "name,μ,end,t\n"
            "B1-B2,2.26e8,SEPARATION,0.0021\n"
            "δ,1,,3\n");
  EXPECT_EQ(Example().Csv({"end", "name"}), "end,name\nSEPARATION,B1-B2\n,δ\n");
  Table table({{"CREATED (UTC)"}, {"TIME LEFT"}});
  table.Add({std::string(""), std::string("a, \"b\"")});
  EXPECT_EQ(table.Csv(), "created,time_left\n,\"a, \"\"b\"\"\"\n");
}

TEST(Table, UnknownColumnIsToldWithThoseThatThereAre) {
  try {
    (void)Example().Text({.columns = {"name", "emd"}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_STREQ(failure.what(),
                 "--columns: there is no column 'emd', did you mean 'end'? — there are name, μ, "
                 "end, t");
  }
}

TEST(Table, NarrowTerminalHasHeadersOfSeveralLinesFirst) {
  Table table({{"bodies[0].velocity_m_per_s", true}, {"VERDICT"}});
  table.Add({std::string("0.1"), std::string("FULL")});
  EXPECT_EQ(table.Text({.width = 20}),
            "   bodies\n"
            "     [0].\n"
            "velocity_\n"
            "  m_per_s  VERDICT\n"
            "      0.1  FULL\n");
}

TEST(Table, TerminalTooNarrowForColumnsHasBlocksOfAllCells) {
  EXPECT_EQ(Example().Text({.width = 12}),
            "NAME   B1-B2\n"
            "μ\n2.26e8\n"
            "END\nSEPARATION\n"
            "t [s]\n0.0021\n"
            "\n"
            "NAME   δ\n"
            "μ      1\n"
            "END    -\n"
            "t [s]  3\n");
}

TEST(Table, LongTableShowsItsFirstAndLastRows) {
  Table table({{"N", true}});
  for (int i = 1; i <= 7; ++i) table.Add({std::to_string(i)});
  EXPECT_EQ(table.Text({}, 7, "… {} more"), "N\n1\n2\n3\n4\n5\n6\n7\n");
  EXPECT_EQ(table.Text({}, 4, "… {} more"), "N\n1\n2\n… 3 more\n6\n7\n");
}

TEST(Table, CellsHaveTheirToneInColorOnly) {
  Table table({{"STATE"}});
  table.Add({{"FAILED", Tone::kBad}});
  EXPECT_EQ(table.Text({}), "STATE\nFAILED\n");
  EXPECT_EQ(table.Text({.color = true}), "\x1b[2mSTATE \x1b[0m\n\x1b[31mFAILED\x1b[0m\n");
}

TEST(Style, LinesAreBrokenBetweenWordsWhateverTheirColour) {
  const Style narrow{.width = 7};
  EXPECT_EQ(Wrap("one two three\n\nδδδ \x1b[1mδδδ\x1b[0m δδδδδδδδ\n", narrow),
            "one two\nthree\n\nδδδ \x1b[1mδδδ\x1b[0m\nδδδδδδδδ\n");
  EXPECT_EQ(Wrap("one two three\n", {}), "one two three\n");
}

TEST(Style, TextIsCutAndPaddedByCharacters) {
  EXPECT_EQ(Cut("δδδ", 2), "δδ");
  EXPECT_EQ(Cut("ab", 5), "ab");
  EXPECT_EQ(Pad("δ", 3), "δ  ");
  EXPECT_EQ(Pad("δ", -3), "  δ");
  EXPECT_EQ(Pad("abc", 2), "abc");
}

}  // namespace
}  // namespace contact::cli
