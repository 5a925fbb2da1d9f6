#include "wire/spec_digest.h"

#include <gtest/gtest.h>

namespace contact {
namespace {

v1::Job Falling() {
  v1::Job job;
  job.mutable_scenario()->add_bodies()->set_name("ball");
  job.mutable_scenario()->set_end_time_s(1);
  return job;
}

TEST(SpecSha256, IsThatOfTheBinaryForm) {
  v1::Job job;
  job.mutable_scenario();
  EXPECT_EQ(SpecSha256(job), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(SpecSha256, DependsOnTheSpecAlone) {
  v1::Job job = Falling();
  const std::string digest = SpecSha256(job);
  EXPECT_EQ(digest.size(), 64U);
  job.set_name("jobs/x");
  (*job.mutable_labels())["a"] = "b";
  job.set_state(v1::Job::SUCCEEDED);
  EXPECT_EQ(SpecSha256(job), digest);
  job.mutable_scenario()->set_end_time_s(2);
  EXPECT_NE(SpecSha256(job), digest);
}

TEST(SpecSha256, OfASweepIsAnotherThanThatOfItsBase) {
  v1::Job sweep;
  *sweep.mutable_sweep()->mutable_base() = Falling().scenario();
  EXPECT_EQ(SpecSha256(sweep).size(), 64U);
  EXPECT_NE(SpecSha256(sweep), SpecSha256(Falling()));
}

TEST(SpecSha256, OfNoSpecIsEmpty) { EXPECT_EQ(SpecSha256(v1::Job()), ""); }

}  // namespace
}  // namespace contact
