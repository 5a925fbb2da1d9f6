#include "jobs/schedule/spec_cache.h"

#include <gtest/gtest.h>

#include <string>

namespace contact {
namespace {

// A job whose spec takes about so many bytes.
v1::Job Job(const std::string& name, std::size_t bytes) {
  v1::Job job;
  job.set_name(name);
  job.mutable_scenario()->add_bodies()->set_name(std::string(bytes, 'x'));
  return job;
}

TEST(SpecCache, GivesEachSpecOnceAndLeavesTheHeader) {
  SpecCache cache;
  v1::Job job = Job("jobs/a", 10);
  const v1::Job whole = job;
  cache.Keep(&job);
  EXPECT_FALSE(job.has_scenario());
  EXPECT_EQ(job.name(), "jobs/a");
  EXPECT_EQ(cache.Take("jobs/b"), nullptr);
  const auto spec = cache.Take("jobs/a");
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->job.SerializeAsString(), whole.SerializeAsString());
  EXPECT_EQ(cache.Take("jobs/a"), nullptr);
}

TEST(SpecCache, HoldsSixteenMebibytesHoweverOftenItIsFilled) {
  constexpr std::size_t kBytes = (4 << 20) - 100;
  SpecCache cache;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 6; ++i) {
      v1::Job job = Job("jobs/" + std::to_string(i), kBytes);
      cache.Keep(&job);
      EXPECT_FALSE(job.has_scenario());
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(cache.Take("jobs/" + std::to_string(i)) != nullptr, i < 4) << i;
    }
  }
}

}  // namespace
}  // namespace contact
