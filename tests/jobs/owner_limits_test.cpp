// What one owner may have of the queue and of the store, and what that costs others: nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "jobs_fixture.h"

namespace contact {
namespace {

using Q = v1::Quota;

const Principal kRoot{"root", "acme", {Role::kAdmin}, "token"};

// A ball that hits a wall at so many velocities.
v1::CreateJobRequest Study(int cells) {
  v1::CreateJobRequest request;
  v1::Sweep& sweep = *request.mutable_job()->mutable_sweep();
  *sweep.mutable_base() = BouncingBall(1);
  v1::Sweep::Axis& axis = *sweep.add_axes();
  axis.set_field("bodies[0].velocity_m_per_s");
  axis.mutable_linear()->set_low(0.1);
  axis.mutable_linear()->set_high(1);
  axis.mutable_linear()->set_count(cells);
  return request;
}

class OwnerLimitsTest : public JobsTest {
 protected:
  void Limit(const OwnerLimits& limits, JobOptions options = {}) {
    options.owner_limits = limits;
    Open(WithFakeRun(std::move(options)));
  }
  Result<v1::Job> CreateAs(const Principal& caller, const v1::CreateJobRequest& request) {
    Await<Result<v1::Job>> result;
    manager_->creator().Create(caller, request, result.callback());
    return result.Get();
  }
  // Why a job of the caller is refused; empty: it is not.
  std::string Refusal(const Principal& caller, const std::string& request_id = "") {
    return Refusal(caller, RequestFor(BouncingBall(), request_id));
  }
  std::string Refusal(const Principal& caller, const v1::CreateJobRequest& request) {
    const Result<v1::Job> job = CreateAs(caller, request);
    if (job.ok()) return "";
    const auto& about = job.error().metadata;
    return about.contains("resource") ? about.at("resource") : job.error().reason;
  }
  v1::Quota Usage(const Principal& caller, v1::Quota::Resource resource) {
    Await<Result<v1::ServerInfo>> info;
    manager_->InfoFor(caller, info.callback());
    const v1::ServerInfo told = info.Get().value();
    const auto found = std::ranges::find(told.quotas(), resource, &v1::Quota::resource);
    return found == told.quotas().end() ? v1::Quota() : *found;
  }
  bool CancelAs(const Principal& caller, const std::string& name) {
    v1::CancelJobRequest request;
    request.set_name(name);
    Await<Result<v1::Job>> result;
    manager_->Cancel(caller, request, result.callback());
    return result.Get().ok();
  }
};

TEST_F(OwnerLimitsTest, OwnerWithAllItsJobsIsRefusedAndOthersAreNot) {
  Limit({.unfinished_jobs = 2});
  EXPECT_EQ(Refusal(kAda), "");
  const std::string waits = CreateAs(kAda, RequestFor(BouncingBall())).value().name();
  run_.AwaitStarted(1);
  EXPECT_EQ(Refusal(kAda), "UNFINISHED_JOBS") << "one runs, one waits";
  EXPECT_EQ(Refusal(kBob), "");
  const v1::Quota jobs = Usage(kAda, Q::UNFINISHED_JOBS);
  EXPECT_EQ(jobs.limit(), 2);
  EXPECT_EQ(jobs.used(), 2);
  EXPECT_EQ(Usage(kAda, Q::RUNNING_JOBS).used(), 1);
  EXPECT_TRUE(CancelAs(kAda, waits));
  EXPECT_EQ(Refusal(kAda), "") << "as soon as the client knows of the end";
}

TEST_F(OwnerLimitsTest, JobThatHasEndedCountsNoMore) {
  Limit({.unfinished_jobs = 1});
  const std::string name = CreateAs(kAda, RequestFor(BouncingBall())).value().name();
  run_.Allow();
  v1::WatchJobRequest request;
  request.set_name(name);
  LogReader reader;
  std::promise<Result<WatchedJob>> watched;
  manager_->watches().WatchJob(kAda, request, reader.wake(), [&watched](Result<WatchedJob> job) {
    watched.set_value(std::move(job));
  });
  const auto job = watched.get_future().get();
  reader.ToEnd(*job.value().cursor);
  EXPECT_EQ(Refusal(kAda), "") << "as soon as the client has seen the end";
}

TEST_F(OwnerLimitsTest, RepeatedRequestIsAnsweredAndNotCountedTwice) {
  Limit({.unfinished_jobs = 2});
  EXPECT_EQ(Refusal(kAda, "first"), "");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Refusal(kAda, "first"), "");
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 1);
  EXPECT_EQ(Refusal(kAda, "second"), "");
  EXPECT_EQ(Refusal(kAda, "first"), "") << "past the limit, too";
  EXPECT_EQ(Refusal(kAda, "third"), "UNFINISHED_JOBS");
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 2);
}

TEST_F(OwnerLimitsTest, InvalidJobsAndMereChecksCountNothing) {
  Limit({.unfinished_jobs = 1, .cells = 5});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Refusal(kAda, v1::CreateJobRequest()), "FIELD_INVALID");
  v1::CreateJobRequest check = Study(50);
  check.set_validate_only(true);
  EXPECT_EQ(Refusal(kAda, check), "");
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 0);
  EXPECT_EQ(Usage(kAda, Q::CELLS).used(), 0);
}

TEST_F(OwnerLimitsTest, CellsOfAllUnfinishedSweepsCountTogether) {
  Limit({.cells = 10});
  EXPECT_EQ(Refusal(kBob), "");
  run_.AwaitStarted(1);  // The worker is busy, so sweeps wait.
  const std::string first = CreateAs(kAda, Study(6)).value().name();
  EXPECT_EQ(Refusal(kAda, Study(5)), "CELLS");
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 1) << "all or nothing";
  EXPECT_EQ(Refusal(kAda, Study(4)), "");
  EXPECT_EQ(Refusal(kAda), "") << "a scenario has no cells";
  EXPECT_EQ(Refusal(kBob, Study(10)), "");
  EXPECT_EQ(Usage(kAda, Q::CELLS).used(), 10);
  EXPECT_TRUE(CancelAs(kAda, first));
  EXPECT_EQ(Usage(kAda, Q::CELLS).used(), 4);
}

TEST_F(OwnerLimitsTest, WhatWasThereBeforeARestartCounts) {
  Limit({.unfinished_jobs = 3, .cells = 10});
  EXPECT_EQ(Refusal(kAda), "");
  run_.AwaitStarted(1);
  EXPECT_EQ(Refusal(kAda, Study(6)), "");
  const std::int64_t bytes = Usage(kAda, Q::STORED_BYTES).used();
  Crash();
  Limit({.unfinished_jobs = 3, .cells = 10});
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 2);
  EXPECT_EQ(Usage(kAda, Q::CELLS).used(), 6);
  EXPECT_GE(Usage(kAda, Q::STORED_BYTES).used(), bytes);
  EXPECT_EQ(Refusal(kAda, Study(5)), "CELLS");
  EXPECT_EQ(Refusal(kAda), "");
  EXPECT_EQ(Refusal(kAda), "UNFINISHED_JOBS");
}

TEST_F(OwnerLimitsTest, OwnerWhoseJobsFillItsShareOfTheStoreIsRefusedUntilItDeletes) {
  Limit({.stored_bytes = 1});
  const std::string name = CreateAs(kAda, RequestFor(BouncingBall())).value().name();
  const Result<v1::Job> second = CreateAs(kAda, RequestFor(BouncingBall()));
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().metadata.at("resource"), "STORED_BYTES");
  EXPECT_GT(std::stoll(second.error().metadata.at("used")), 100);
  EXPECT_EQ(second.error().retry_after.count(), 0) << "no waiting helps";
  EXPECT_EQ(Refusal(kBob), "");
  run_.AwaitStarted(1);
  EXPECT_TRUE(CancelAs(kAda, name)) << "what it has goes on";
}

TEST_F(OwnerLimitsTest, SomePlacesOfTheQueueAreForAdmins) {
  Limit({}, {.max_queued_jobs = 4, .admin_slots = 1});
  EXPECT_EQ(Refusal(kBob), "");
  run_.AwaitStarted(1);
  for (const char* expected : {"", "", "", "QUEUE_FULL"}) EXPECT_EQ(Refusal(kAda), expected);
  EXPECT_EQ(Refusal(kRoot), "");
  EXPECT_EQ(Refusal(kRoot), "QUEUE_FULL") << "there are no more";
}

TEST_F(OwnerLimitsTest, SomePlacesOfWatchersAreForAdmins) {
  Limit({}, {.admin_slots = 10, .max_watchers = 2});
  LogReader reader;
  const auto watch = [&](const Principal& caller) {
    return manager_->watches().WatchJobs(caller, {}, reader.wake());
  };
  const auto first = watch(kAda);
  EXPECT_EQ(watch(kBob).error().reason, "WATCHER_LIMIT");
  EXPECT_TRUE(watch(kRoot).ok());
}

TEST_F(OwnerLimitsTest, FullDiskTakesNoJobsAndKeepsThoseThatAreThere) {
  DiskSpace disk{.total = 1'000'000'000, .free = 200'000'001};
  JobOptions options{.max_disk_percent = 80, .disk = [&disk] { return disk; }};
  Limit({}, options);
  EXPECT_EQ(Refusal(kAda, "first"), "");
  run_.AwaitStarted(1);
  disk.free = 180'000'000;
  const Result<v1::Job> refused = CreateAs(kAda, RequestFor(BouncingBall()));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "STORE_FULL");
  EXPECT_EQ(
      refused.error().message,
      "the disk of the store is 82 % full, 180 MB are left; new jobs are accepted up to 80 %: "
      "delete jobs, or have the server's disk cleared");
  EXPECT_EQ(Refusal(kAda, "first"), "") << "it was accepted before";
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 1);
  EXPECT_EQ(Usage(kAda, Q::RUNNING_JOBS).used(), 1) << "what runs goes on";
  disk = {.total = 1'000'000'000'000, .free = 20'000'000'000};
  EXPECT_EQ(Refusal(kAda), "") << "the last gigabytes of a large disk are enough";
  disk = {};
  EXPECT_EQ(Refusal(kAda), "") << "nobody knows";
}

TEST_F(OwnerLimitsTest, ConcurrentRequestsNeverGetMoreThanTheLimit) {
  Limit({.unfinished_jobs = 5});
  std::atomic<int> accepted = 0;
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&] {
      for (int i = 0; i < 10; ++i) {
        Await<Result<v1::Job>> result;
        manager_->creator().Create(kAda, RequestFor(BouncingBall()), result.callback());
        accepted += result.Get().ok() ? 1 : 0;
      }
    });
  }
  threads.clear();
  EXPECT_EQ(accepted, 5);
  EXPECT_EQ(Usage(kAda, Q::UNFINISHED_JOBS).used(), 5);
}

}  // namespace
}  // namespace contact
