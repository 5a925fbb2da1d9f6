#include "cli/input/measured.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cli/base/failure.h"
#include "cli/base/text_file.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MeasuredTest : public testing::Test {
 protected:
  MeasuredTable Read(const std::string& text) {
    WriteText(text, path_);
    return ReadTable(path_);
  }

  std::string Refused(const std::string& text) {
    try {
      Read(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kInvalidScenario);
      return failure.what();
    }
    return "no failure";
  }

  const TempDirectory folder_;
  const std::string path_ = folder_.path() / "m.csv";
};

TEST_F(MeasuredTest, HeadersHaveNamesAndUnits) {
  const MeasuredTable table = Read("time [ms],B1.velocity (mm/s),force_N\n0,1,2\n");
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "ms");
  EXPECT_EQ(table.columns[1].name, "B1.velocity");
  EXPECT_EQ(table.columns[1].unit, "mm/s");
  EXPECT_EQ(table.columns[2].name, "force_N");
  EXPECT_EQ(table.columns[2].unit, "");
  EXPECT_EQ(table.Headers(), "time [ms], B1.velocity (mm/s), force_N");
}

TEST_F(MeasuredTest, SeparatorIsThatOfTheHeader) {
  for (const char* text : {"t,a\n1,2\n3,4\n", "t;a\n1;2\n3;4\n", "t\ta\n1\t2\n3\t4\n"}) {
    const MeasuredTable table = Read(text);
    ASSERT_EQ(table.columns.size(), 2U) << text;
    EXPECT_THAT(table.columns[0].values, ElementsAre(1, 3));
    EXPECT_THAT(table.columns[1].values, ElementsAre(2, 4));
  }
}

TEST_F(MeasuredTest, WhatRecordersWriteAroundTheNumbersIsNoMistake) {
  const MeasuredTable table = Read(
      "\xEF\xBB\xBF# run 7\r\n\"t [s]\", \"a, b [N]\"\r\n\r\n 1 , 2e3\r\n# break\r\n2,\r\n3,.nan");
  EXPECT_EQ(table.columns[1].name, "a, b");
  EXPECT_THAT(table.columns[0].values, ElementsAre(1, 2, 3));
  EXPECT_EQ(table.columns[1].values[0], 2000);
  EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
  EXPECT_TRUE(std::isnan(table.columns[1].values[2]));
}

TEST_F(MeasuredTest, ARowThatEndsEarlyHasNoNumberThere) {
  EXPECT_TRUE(std::isnan(Read("t,a\n1\n").columns[1].values[0]));
}

TEST_F(MeasuredTest, MistakesAreToldTogetherAtTheirPlaces) {
  EXPECT_EQ(Refused("t,a\n1,x\n2,3,4\n\"1,5\",2\n"),
            path_ + ":2:3: expected a number, got 'x'\n" + path_ +
                ":3:5: has 3 fields; the header has 2 — decimals are written with a point\n" +
                path_ +
                ":4:1: expected a number, got '1,5' — decimals are written with a point\n3 errors");
}

TEST_F(MeasuredTest, WhatIsNoTableIsTold) {
  EXPECT_THAT(Refused(""), HasSubstr("has no rows"));
  EXPECT_THAT(Refused("t,a\n"), HasSubstr("has no rows"));
  EXPECT_THAT(Refused("t\n1\n"), HasSubstr("has one column"));
  EXPECT_THROW(ReadTable(folder_.path() / "none.csv"), Failure);
}

TEST_F(MeasuredTest, ATableIsAFileThatIsNoJson) {
  WriteText("t,a\n1,2\n", path_);
  EXPECT_TRUE(IsTable(path_));
  WriteText(" {\"name\": \"jobs/1\"}", path_);
  EXPECT_FALSE(IsTable(path_));
  EXPECT_FALSE(IsTable("eh0scma960"));
  EXPECT_FALSE(IsTable(folder_.path()));
}

}  // namespace
}  // namespace contact::cli
