#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/link/jobs.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
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

}  // namespace
}  // namespace contact::cli
