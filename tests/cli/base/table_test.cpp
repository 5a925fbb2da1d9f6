#include "cli/base/table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

Table ExampleTable() {
  Table table({{"NAME"}, {"μ", true}, {"END", false, 2}, {"t [s]", true, 1}});
  table.Add({std::string("B1-B2"), std::string("2.26e8"), std::string("SEPARATION"),
             std::string("0.0021")});
  table.Add({std::string("δ"), std::string("1"), std::string("-"), std::string("3")});
  return table;
}

TEST(Table, ColumnsAreAsWideAsTheirWidestCellInCharacters) {
  EXPECT_EQ(ExampleTable().Text({}),
            "NAME        μ  END          t [s]\n"
            "B1-B2  2.26e8  SEPARATION  0.0021\n"
            "δ           1  -                3\n");
}

TEST(Table, NarrowTerminalLosesTheColumnsToSpareFirst) {
  EXPECT_EQ(ExampleTable().Text({.width = 32}),
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
  EXPECT_EQ(ExampleTable().Text({.columns = {"t", "end", "NAME"}}),
            " t [s]  END         NAME\n"
            "0.0021  SEPARATION  B1-B2\n"
            "     3  -           δ\n");
  EXPECT_EQ(ExampleTable().Text({.width = 25, .columns = {"t", "end", "NAME"}}),
            ExampleTable().Text({.columns = {"t", "end", "NAME"}}));
  Table table({{"NAME"}, {"W_c [J]", true, Table::kOnlyWide, "work"}});
  table.Add({std::string("B1-B2"), std::string("2.5")});
  EXPECT_EQ(table.Text({.columns = {"work"}}), "W_c [J]\n    2.5\n");
}

TEST(Table, CsvHasNamesWithoutUnitsAndNothingForADash) {
  EXPECT_EQ(ExampleTable().Csv(),
            "name,μ,end,t\n"
            "B1-B2,2.26e8,SEPARATION,0.0021\n"
            "δ,1,,3\n");
  EXPECT_EQ(ExampleTable().Csv({"end", "name"}), "end,name\nSEPARATION,B1-B2\n,δ\n");
  Table table({{"CREATED (UTC)"}, {"TIME LEFT"}});
  table.Add({std::string(""), std::string("a, \"b\"")});
  EXPECT_EQ(table.Csv(), "created,time_left\n,\"a, \"\"b\"\"\"\n");
}

TEST(Table, UnknownColumnIsToldWithThoseThatThereAre) {
  try {
    (void)ExampleTable().Text({.columns = {"name", "emd"}});
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
  EXPECT_EQ(ExampleTable().Text({.width = 12}),
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
  EXPECT_EQ(table.Text({}, 6, "… {} more"), "N\n1\n2\n3\n4\n5\n6\n7\n");
  EXPECT_EQ(table.Text({}, 4, "… {} more"), "N\n1\n2\n… 3 more\n6\n7\n");
}

// A table of random columns and cells; `random` decides on everything. No word is longer than 20.
Table RandomTable(std::mt19937& random) {
  const auto words = [&random](std::size_t most) {
    std::string text;
    for (std::size_t count = random() % (most + 1); count > 0; --count) {
      text += text.empty() ? "" : " ";
      for (std::size_t size = 1 + random() % 20; size > 0; --size) {
        text +=
            random() % 5 == 0 ? "\u03b4" : std::string(1, static_cast<char>('a' + random() % 26));
      }
    }
    return text;
  };
  std::vector<Table::Column> columns(1 + random() % 12);
  for (Table::Column& column : columns) {
    column = {"x" + words(2), random() % 2 == 0, static_cast<int>(random() % 4) - 1};
  }
  Table table(columns);
  for (std::size_t rows = random() % 6; rows > 0; --rows) {
    std::vector<Table::Cell> row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      row.emplace_back(words(3), random() % 2 == 0 ? Tone::kBad : Tone::kPlain);
    }
    table.Add(std::move(row));
  }
  return table;
}

TEST(Table, NoRowIsWiderThanTheTerminal) {
  std::mt19937 random(1);
  for (int width = 40; width <= 200; ++width) {
    const Table table = RandomTable(random);
    for (const bool wide : {false, true}) {
      const Style style{.color = random() % 2 == 0, .width = width, .wide = wide};
      std::istringstream lines(table.Text(style));
      for (std::string line; std::getline(lines, line);) {
        ASSERT_LE(Width(line), width) << line << "\nin\n" << table.Text(style);
      }
    }
  }
}

TEST(Table, NoCellIsLostWhereColumnsAreAskedFor) {
  std::mt19937 random(2);
  for (int width = 40; width <= 200; width += 10) {
    Table table({{"A"}, {"B", true, 2}, {"C", false, Table::kOnlyWide}});
    std::vector<std::string> cells;
    for (int i = 0; i < 3; ++i) cells.push_back(std::string(1 + random() % 40, 'x') + "|");
    table.Add({cells[0], cells[1], cells[2]});
    const std::string text = table.Text({.width = width, .columns = {"c", "a", "b"}});
    for (const std::string& cell : cells) EXPECT_THAT(text, testing::HasSubstr(cell));
  }
}

TEST(Table, CsvHasEveryRowAndColumnHoweverNarrowTheTerminal) {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Table table = RandomTable(random);
    const std::string csv = table.Csv();
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const auto commas = std::ranges::count(line, ',');
    while (std::getline(lines, line)) EXPECT_EQ(std::ranges::count(line, ','), commas) << csv;
  }
}

TEST(Table, RequiredColumnsMayBeNamedByNameOrHeader) {
  const std::vector<Table::Column> columns = {{"CREATED (UTC)"}, {"W_c [J]", true, 0, "work"}};
  EXPECT_NO_THROW(Table::RequireColumns(columns, {"created", "CREATED (UTC)", "WORK", "W_c [J]"}));
  EXPECT_NO_THROW(Table::RequireColumns(columns, {}));
  EXPECT_THROW(Table::RequireColumns(columns, {"created", "w_c"}), Failure);
}

TEST(Table, NoLineEndsWithASpace) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    EXPECT_THAT(RandomTable(random).Text({.width = 60}), testing::Not(testing::HasSubstr(" \n")));
  }
}

TEST(Table, CellsHaveTheirToneInColorOnly) {
  Table table({{"STATE"}});
  table.Add({{"FAILED", Tone::kBad}});
  EXPECT_EQ(table.Text({}), "STATE\nFAILED\n");
  EXPECT_EQ(table.Text({.color = true}), "\x1b[2mSTATE \x1b[0m\n\x1b[31mFAILED\x1b[0m\n");
}

}  // namespace
}  // namespace contact::cli
