#include "cli/export/series_selection.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<SampleColumn> Columns() {
  return {{"time", "time", "s", {0, 1, 2, 3, 4}},
          {"B1.velocity", "velocity", "m/s", {10, 11, 12, 13, 14}},
          {"B2.velocity", "velocity", "m/s", {20, 21, 22, 23, 24}}};
}

std::vector<SampleColumn> Narrowed(const SeriesSelection& selection) {
  std::vector<SampleColumn> columns = Columns();
  Narrow(selection, &columns);
  return columns;
}

TEST(SeriesSelection, NothingSelectedIsAll) {
  EXPECT_TRUE(SeriesSelection().empty());
  const auto columns = Narrowed({});
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_EQ(columns[2].values, Columns()[2].values);
}

TEST(SeriesSelection, TimeComesBeforeTheChannelsInTheirOrder) {
  const auto columns =
      Narrowed({.channels = {"B2.velocity", "B1.velocity", "B2.velocity", "time"}});
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_EQ(columns[0].name, "time");
  EXPECT_EQ(columns[1].name, "B2.velocity");
  EXPECT_EQ(columns[2].name, "B1.velocity");
}

TEST(SeriesSelection, BothEndsOfTheTimeRangeAreInIt) {
  EXPECT_THAT(Narrowed({.from = 1, .to = 3})[0].values, ElementsAre(1, 2, 3));
  EXPECT_THAT(Narrowed({.from = 0.5, .to = 2.5})[1].values, ElementsAre(11, 12));
  EXPECT_THAT(Narrowed({.from = 4.5})[0].values, ElementsAre());
  EXPECT_THAT(Narrowed({.to = -1})[0].values, ElementsAre());
}

TEST(SeriesSelection, EveryCountsFromTheFirstSampleOfTheRange) {
  EXPECT_THAT(Narrowed({.every = 2})[0].values, ElementsAre(0, 2, 4));
  EXPECT_THAT(Narrowed({.from = 1, .every = 3})[0].values, ElementsAre(1, 4));
  EXPECT_THAT(Narrowed({.every = 100})[0].values, ElementsAre(0));
}

TEST(SeriesSelection, UnknownChannelIsAUsageErrorWithTheNearest) {
  try {
    Narrowed({.channels = {"B1.velocty"}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_THAT(failure.what(), HasSubstr("did you mean 'B1.velocity'?"));
  }
}

TEST(SeriesSelection, AJobWithoutATrajectoryHasNothingToSelect) {
  std::vector<SampleColumn> none;
  Narrow({.channels = {"B1.velocity"}}, &none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace contact::cli
