#include "cli/input/measured.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kRows[] = "0,0\n1.5,2.25\n3,-4.5\n4.5,1\n";

std::string Replaced(std::string text, char from, const std::string& to) {
  std::string made;
  for (const char c : text) made += c == from ? to : std::string(1, c);
  return made;
}

std::string Wide(const std::string& text, bool little) {
  std::string made = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) made += little ? std::string{c, '\0'} : std::string{'\0', c};
  return made;
}

// The same table as loggers write it.
std::map<std::string, std::string> Dialects() {
  const std::string commas = std::string("time [ms],force [kN]\n") + kRows;
  const std::string semicolons = Replaced(Replaced(commas, ',', ";"), '.', ",");
  return {
      {"commas", commas},
      {"semicolons", semicolons},
      {"tabs", Replaced(semicolons, ';', "\t")},
      {"spaces", Replaced(Replaced(commas, ',', "   "), '\n', "\n  ")},
      {"spaces and decimal commas", Replaced(semicolons, ';', "  ")},
      {"row of units", std::string("time,force\nms,kN\n") + kRows},
      {"row of units in brackets", std::string("time,force\n[ms],[kN]\n") + kRows},
      {"preamble", "Logger 7\nRate,2000\nDate,24.12.25\n\n" + commas},
      {"numbers before", "Channels;2\nRate;2000\n" + semicolons},
      {"comments", "# run 7\n# second line, of it\n" + commas},
      {"header in a comment", "# " + commas},
      {"byte order mark", "\xEF\xBB\xBF" + commas},
      {"UTF-16, little", Wide(commas, true)},
      {"UTF-16, big", Wide(commas, false)},
      {"Latin-1",
       "Gr\xF6\xDF"
       "e,1\n" +
           commas},
      {"Windows", Replaced(commas, '\n', "\r\n")},
      {"quotes", std::string("\"time [ms]\",\"force [kN]\"\n") + kRows},
      {"separators at the end", Replaced(Replaced(commas, '\n', ",\n"), ',', ";")},
  };
}

std::vector<double> NumbersOf(const MeasuredTable& table, std::size_t column) {
  std::vector<Diagnostic> mistakes;
  std::vector<double> numbers = table.Numbers(column, MeasuredTable::Gap::kMistake, &mistakes);
  for (const Diagnostic& mistake : mistakes) ADD_FAILURE() << Format(mistake);
  return numbers;
}

// All mistakes in a column of a text, or why it is no table.
std::vector<std::string> MistakesIn(const std::string& text, std::size_t column = 1,
                                    MeasuredTable::Gap gap = MeasuredTable::Gap::kMistake) {
  std::vector<Diagnostic> mistakes;
  try {
    MeasuredTable("m", text).Numbers(column, gap, &mistakes);
  } catch (const InvalidFile& invalid) {
    mistakes = invalid.mistakes();
  }
  std::vector<std::string> lines;
  for (const Diagnostic& mistake : mistakes) lines.push_back(Format(mistake));
  return lines;
}

TEST(MeasuredTable, EachDialectIsTheSameTable) {
  for (const auto& [name, text] : Dialects()) {
    SCOPED_TRACE(name);
    const MeasuredTable table("m", text);
    ASSERT_EQ(table.columns().size(), 2U);
    EXPECT_EQ(table.columns()[0].name, "time");
    EXPECT_EQ(table.columns()[0].unit, "ms");
    EXPECT_EQ(table.columns()[1].name, "force");
    EXPECT_EQ(table.columns()[1].unit, "kN");
    EXPECT_EQ(table.TimeColumn(), 0U);
    EXPECT_THAT(NumbersOf(table, 0), ElementsAre(0, 1.5, 3, 4.5));
    EXPECT_THAT(NumbersOf(table, 1), ElementsAre(0, 2.25, -4.5, 1));
  }
}

TEST(MeasuredTable, HeadersHaveNamesAndUnits) {
  const MeasuredTable table("m", "time [ms],B1.velocity (mm/s),force_N\n0,1,2\n");
  ASSERT_EQ(table.columns().size(), 3U);
  EXPECT_EQ(table.columns()[1].name, "B1.velocity");
  EXPECT_EQ(table.columns()[1].unit, "mm/s");
  EXPECT_EQ(table.columns()[2].name, "force_N");
  EXPECT_EQ(table.columns()[2].unit, "");
  EXPECT_EQ(table.Headers(), "time [ms], B1.velocity (mm/s), force_N");
  EXPECT_EQ(MeasuredTable("m", "0 1\n2 3\n").Headers(), "1, 2") << "of columns without headers";
}

TEST(MeasuredTable, LinesThatAreSkippedAreNotLookedAt) {
  const MeasuredTable table("m", "1,2\n3,4\nt,F\n5,6\n7,8\n", 2);
  EXPECT_THAT(NumbersOf(table, 0), ElementsAre(5, 7));
  EXPECT_EQ(table.Headers(), "t, F");
}

TEST(MeasuredTable, MistakesAreToldTogetherAtTheirPlaces) {
  EXPECT_THAT(
      MistakesIn("t,F\n0,1\n1,x\n2,\n3,nan\n4,5\n5,6,7\n6,\"1,5\"\n8,9\n"),
      ElementsAre("m:3:3: expected a number, got 'x'", HasSubstr("m:4:3: has no number"),
                  HasSubstr("m:5:3: is nan"),
                  "m:7:5: has 3 fields; others have 2 — decimals are written with a point",
                  "m:8:3: expected a number, got '1,5' — decimals are written with a point"));
  EXPECT_THAT(
      MistakesIn("t;F\n0,1;1\n1;2.5\n2;3\n3;4\n", 0),
      ElementsAre("m:2:1: expected a number, got '0,1' — decimals are written with a point"));
  EXPECT_THAT(MistakesIn("t;F\nx;1\n1;y\n2;3\n3;4\n"),
              ElementsAre("m:3:3: expected a number, got 'y'"));
  EXPECT_THAT(MistakesIn("t,F\n0,x\ny,1\n1,2,3\n2,3\n3,4\n4,5\n5,6\n"),
              ElementsAre("m:2:3: expected a number, got 'x'", HasSubstr("m:4:5: has 3 fields")))
      << "mistakes hide no rows";
  EXPECT_THAT(MistakesIn("t,F\n0,0,1,5\n0,5,2,5\n1,0,3,5\n"),
              ElementsAre(HasSubstr("m:2:1: has 4 fields; the header has 2")));
}

TEST(MeasuredTable, WhatIsNoTableIsTold) {
  for (const char* text : {"", "t,F\n", "t\n1\n2\n", "only words\nand more\n"}) {
    EXPECT_THAT(MistakesIn(text), ElementsAre(HasSubstr("m:1:1: has no rows of numbers"))) << text;
  }
  EXPECT_THROW(MeasuredTable::Open("/none.csv"), Failure);
}

TEST(MeasuredTable, GapsAreNaNWhereTheyMayBe) {
  std::vector<Diagnostic> mistakes;
  const auto numbers = MeasuredTable("m", "t,F\n0,1\n1,\n2,.nan\n3,4\n")
                           .Numbers(1, MeasuredTable::Gap::kNaN, &mistakes);
  ASSERT_EQ(numbers.size(), 4U);
  EXPECT_TRUE(std::isnan(numbers[1]) && std::isnan(numbers[2]));
  EXPECT_EQ(numbers[3], 4);
  EXPECT_TRUE(mistakes.empty());
}

TEST(MeasuredTable, IsAFileThatIsNoJson) {
  const TempDirectory folder;
  const std::string path = folder.path() / "m.csv";
  WriteText("t,a\n1,2\n", path);
  EXPECT_TRUE(IsTable(path));
  EXPECT_THAT(NumbersOf(MeasuredTable::Open(path), 1), ElementsAre(2));
  WriteText(" {\"name\": \"jobs/1\"}", path);
  EXPECT_FALSE(IsTable(path));
  EXPECT_FALSE(IsTable("eh0scma960"));
  EXPECT_FALSE(IsTable(folder.path()));
}

}  // namespace
}  // namespace contact::cli
