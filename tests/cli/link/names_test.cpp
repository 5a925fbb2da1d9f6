#include <gmock/gmock.h>

#include <cstring>

#include "cli/base/failure.h"
#include "cli/link/columns.h"
#include "cli/link/job_names.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(JobNames, LongAndShortNamesAreOfTheSameJob) {
  for (const char* job : {"x1", "jobs/x1"}) {
    EXPECT_EQ(JobName(job), "jobs/x1");
    EXPECT_EQ(ShortName(job), "x1");
  }
}

TEST(JobNames, RequestIdsDiffer) {
  EXPECT_EQ(RandomRequestId().size(), 36U);
  EXPECT_NE(RandomRequestId(), RandomRequestId());
}

TEST(JobNames, LabelsAreSplitAtTheirFirstSign) {
  EXPECT_THAT(ParseLabels({"a=1", "b=x=y", "c=", "a=2"}),
              ElementsAre(Pair("a", "2"), Pair("b", "x=y"), Pair("c", "")));
  for (const char* text : {"a", "", "=1"}) {
    try {
      ParseLabels({text});
      ADD_FAILURE() << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
    }
  }
}

TEST(Columns, BytesAreDoubles) {
  const std::vector<double> values = {0.1, -0.0, 1e300};
  std::string bytes(values.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  EXPECT_EQ(Doubles(bytes), values);
  EXPECT_THAT(Doubles(""), IsEmpty());
  EXPECT_THAT(Doubles(bytes.substr(0, 15)), ElementsAre(0.1));
}

TEST(Columns, ChunksAreJoined) {
  const double one = 1;
  std::string bytes(sizeof one, '\0');
  std::memcpy(bytes.data(), &one, sizeof one);
  std::vector<double> values = {0};
  AppendDoubles(bytes, &values);
  AppendDoubles("", &values);
  AppendDoubles(bytes, &values);
  EXPECT_THAT(values, ElementsAre(0, 1, 1));
}

}  // namespace
}  // namespace contact::cli
