#include "storage/sqlite/commit_thread.h"

#include <latch>
#include <numeric>
#include <thread>

#include "storage/store.h"
#include "storage/store_fixture.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

TEST_F(StoreTest, FullStoreRefusesWhatDoesNotFitAndKeepsTheRest) {
  Open({.max_bytes = 1'000'000});
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  // All in one batch or not: the big one must not take the small ones down with it.
  const std::string name = "jobs/a";
  const std::vector<v1::Event> small = {LogEvent("small")};
  const std::vector<v1::Event> big = {LogEvent(std::string(2'000'000, 'x'))};
  Await<absl::StatusOr<std::uint64_t>> before, full, after;
  store_->Update({.name = name, .epoch = 0, .events = small}, before.callback());
  store_->Update({.name = name, .epoch = 0, .events = big}, full.callback());
  store_->Update({.name = name, .epoch = 0, .events = small}, after.callback());
  EXPECT_EQ(*before.Get(), 2U);
  EXPECT_TRUE(absl::IsResourceExhausted(full.Get().status()));
  EXPECT_EQ(*after.Get(), 3U);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 3U);
}

TEST_F(StoreTest, FullStoreWorksAgainAfterADelete) {
  Open({.max_bytes = 1'000'000});
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  const std::vector<v1::Event> big = {LogEvent(std::string(600'000, 'x'))};
  ASSERT_TRUE(Append("jobs/a", big).ok());
  job.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &job}).ok());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  ASSERT_TRUE(absl::IsResourceExhausted(Append("jobs/b", big).status()));
  ASSERT_TRUE(Delete("jobs/a").ok());
  absl::StatusOr<std::uint64_t> appended;
  for (int i = 0; i < 100 && !appended.ok(); ++i) appended = Append("jobs/b", big);
  EXPECT_TRUE(appended.ok()) << appended.status();
}

TEST_F(StoreTest, ManyWritersLoseNothing) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  constexpr std::ptrdiff_t kThreads = 4;
  constexpr std::ptrdiff_t kAppends = 500;
  std::latch done(kThreads * kAppends);
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      const std::string name = "jobs/a";
      const std::vector<v1::Event> events = {LogEvent("x"), LogEvent("y")};
      for (int i = 0; i < kAppends; ++i) {
        store_->Update({.name = name, .epoch = 0, .events = events},
                       [&](const absl::StatusOr<std::uint64_t>& first) {
                         EXPECT_TRUE(first.ok());
                         done.count_down();
                       });
      }
    });
  }
  done.wait();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 1U + 2U * kThreads * kAppends);
}

TEST_F(StoreTest, WhatWasAskedForIsDoneBeforeItCloses) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::string name = "jobs/a";
  const std::vector<v1::Event> events = {LogEvent("x")};
  int done = 0;  // Of the store's thread until that has ended.
  for (int i = 0; i < 500; ++i) {
    store_->Update({.name = name, .epoch = 0, .events = events},
                   [&done](const auto& first) { done += first.ok() ? 1 : 0; });
  }
  store_.reset();
  EXPECT_EQ(done, 500);
  Open();
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 501U);
}

TEST_F(StoreTest, CommitsAreCountedAndTimedByTheClock) {
  const FakeClock clock(std::chrono::milliseconds(250));  // A commit reads it twice.
  const auto metrics = std::make_shared<StoreMetrics>();
  Open({.metrics = metrics, .clock = &clock});
  for (const char* name : {"jobs/a", "jobs/b", "jobs/c"}) {
    ASSERT_TRUE(Create(MakeJob(name)).ok());
  }
  EXPECT_TRUE(absl::IsNotFound(Append("jobs/none", {}).status()));
  store_.reset();
  const Histogram::Snapshot operations = metrics->commit_operations.Get();
  EXPECT_EQ(operations.sum, 4) << "an operation that finds nothing to do shares a commit, too";
  const auto commits =
      std::accumulate(operations.counts.begin(), operations.counts.end(), std::int64_t{0});
  EXPECT_EQ(commits, 4) << "each waited for the one before";
  EXPECT_EQ(metrics->commit_seconds.Get().sum, 0.25 * static_cast<double>(commits));
  EXPECT_EQ(metrics->failed_commits, 0);
}

TEST_F(StoreTest, LogIsFoldedIntoTheDatabaseBeforeItGrowsLarge) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(Append("jobs/a", {LogEvent(std::string(500'000, 'x'))}).ok());
  }
  EXPECT_LT(std::filesystem::file_size(path() / "contactd.db-wal"), 6'000'000U);
}

}  // namespace
}  // namespace contact
