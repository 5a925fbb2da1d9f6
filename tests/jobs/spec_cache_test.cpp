#include "jobs/schedule/spec_cache.h"

#include <gtest/gtest.h>

#include <string>

namespace contact {
namespace {

// A job whose spec takes about so many bytes.
StoredJob Job(const std::string& name, std::size_t bytes) {
  StoredJob stored;
  stored.job.set_name(name);
  stored.job.mutable_scenario()->add_bodies()->set_name(std::string(bytes, 'x'));
  return stored;
}

TEST(SpecCache, GivesEachSpecOnceAndLeavesTheHeader) {
  SpecCache cache;
  StoredJob stored = Job("jobs/a", 10);
  stored.checkpoint = "state";
  const v1::Job whole = stored.job;
  cache.Keep(&stored);
  EXPECT_FALSE(stored.job.has_scenario());
  EXPECT_EQ(stored.job.name(), "jobs/a");
  EXPECT_EQ(cache.Take("jobs/b"), nullptr);
  const auto spec = cache.Take("jobs/a");
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->job.SerializeAsString(), whole.SerializeAsString());
  EXPECT_EQ(spec->checkpoint, "state");
  EXPECT_EQ(cache.Take("jobs/a"), nullptr);
}

TEST(SpecCache, KeepsNoJobWithoutSpec) {
  SpecCache cache;
  StoredJob header;
  header.job.set_name("jobs/a");
  cache.Keep(&header);
  EXPECT_EQ(cache.Take("jobs/a"), nullptr);
}

TEST(SpecCache, HoldsSixteenMebibytesHoweverOftenItIsFilled) {
  constexpr std::size_t kBytes = (4 << 20) - 100;
  SpecCache cache;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 6; ++i) {
      StoredJob stored = Job("jobs/" + std::to_string(i), kBytes);
      cache.Keep(&stored);
      EXPECT_FALSE(stored.job.has_scenario());
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(cache.Take("jobs/" + std::to_string(i)) != nullptr, i < 4) << i;
    }
  }
}

}  // namespace
}  // namespace contact
