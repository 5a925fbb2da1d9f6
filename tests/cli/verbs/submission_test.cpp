#include "cli/verbs/job/submission.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

// The job that a command line asks for.
v1::Job JobOf(const std::string& words) {
  CLI::App app;
  Submission submission;
  submission.AddTo(app, "scenario");
  app.parse(words);
  return submission.Request().job();
}

TEST(SubmissionTest, WithoutFlagsTheJobIsUnlimited) {
  const v1::Job job = JobOf("");
  EXPECT_EQ(job.priority(), 0);
  EXPECT_FALSE(job.has_budget());
  EXPECT_FALSE(job.has_time_to_live());
}

TEST(SubmissionTest, EachFlagFillsItsField) {
  const v1::Job job =
      JobOf("--priority -7 --budget-wall-time 2m --budget-steps 1e6 --budget-output 10kB --ttl 1h");
  EXPECT_EQ(job.priority(), -7);
  EXPECT_EQ(job.budget().wall_time().seconds(), 120);
  EXPECT_EQ(job.budget().steps(), 1'000'000);
  EXPECT_EQ(job.budget().output_bytes(), 10'000);
  EXPECT_EQ(job.time_to_live().seconds(), 3600);
}

TEST(SubmissionTest, FractionsOfASecondAreKept) {
  EXPECT_EQ(JobOf("--budget-wall-time 250ms").budget().wall_time().nanos(), 250'000'000);
}

TEST(SubmissionTest, TextThatIsNoTimeOrNumberIsAUsageError) {
  for (const char* words :
       {"--budget-wall-time soon", "--ttl 5parsecs", "--budget-steps 1.5", "--budget-steps many"}) {
    try {
      JobOf(words);
      FAIL() << words;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage) << words;
    }
  }
}

}  // namespace
}  // namespace contact::cli
