#include "jobs/schedule/retention.h"

#include "jobs/log/job_feed.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using std::chrono::hours;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

WallTime At(int second) { return WallTime(seconds(second)); }

TEST(Expired, JobsGoWhenTheirTimeHasCome) {
  const std::vector<EndedJob> jobs = {{"a", At(10)}, {"b", {}}, {"c", At(11)}, {"d", At(9)}};
  EXPECT_THAT(Expired(jobs, At(8), {}), IsEmpty());
  EXPECT_THAT(Expired(jobs, At(10), {}), ElementsAre("a", "d"));
}

TEST(Expired, OldestEndGoesUntilTheRestFits) {
  const std::vector<EndedJob> jobs = {{"a", {}, 10}, {"b", {}, 10}, {"c", {}, 10}};
  EXPECT_THAT(Expired(jobs, At(0), {}), IsEmpty());
  EXPECT_THAT(Expired(jobs, At(0), {.bytes = 30}), IsEmpty());
  EXPECT_THAT(Expired(jobs, At(0), {.bytes = 29}), ElementsAre("a"));
  EXPECT_THAT(Expired(jobs, At(0), {.bytes = 1}), ElementsAre("a", "b", "c"));
}

TEST(Expired, WhatIsTooOldMakesRoomForTheRest) {
  const std::vector<EndedJob> jobs = {{"a", {}, 10}, {"b", At(5), 10}, {"c", {}, 10}};
  EXPECT_THAT(Expired(jobs, At(5), {.bytes = 20}), ElementsAre("b"));
  EXPECT_THAT(Expired(jobs, At(5), {.bytes = 19}), ElementsAre("b", "a"));
}

TEST(Expired, OfManyATenthGoesForItsAgeAndAllThatAskedForIt) {
  std::vector<EndedJob> jobs(200, {"old", At(5)});
  EXPECT_EQ(Expired(jobs, At(5), {}).size(), 20U);
  jobs.resize(15);
  EXPECT_EQ(Expired(jobs, At(5), {}).size(), 10U);
  for (EndedJob& job : jobs) job.asked = true;
  EXPECT_EQ(Expired(jobs, At(5), {}).size(), 15U);
}

TEST(ExpiryOf, JobSaysItOrElseTheServer) {
  v1::Job job;
  job.set_state(v1::Job::RUNNING);
  job.mutable_time_to_live()->set_seconds(60);
  EXPECT_EQ(ExpiryOf(job, {.age = hours(1)}), std::nullopt) << "it has not ended";
  job.set_state(v1::Job::FAILED);
  job.mutable_end_time()->set_seconds(1000);
  EXPECT_EQ(ExpiryOf(job, {.age = hours(1)}), At(1060));
  job.clear_time_to_live();
  EXPECT_EQ(ExpiryOf(job, {.age = hours(1)}), At(4600));
  EXPECT_EQ(ExpiryOf(job, {}), std::nullopt);
}

class RetentionTest : public JobsTest {
 protected:
  std::string EndedJobName(int time_to_live_s = 0) {
    v1::CreateJobRequest request = RequestFor(BouncingBall());
    if (time_to_live_s > 0) {
      request.mutable_job()->mutable_time_to_live()->set_seconds(time_to_live_s);
    }
    run_.Allow();
    std::string name = Create(request).value().name();
    Ended(name);
    return name;
  }

  JobFeed feed_;
};

TEST_F(RetentionTest, EndedJobsGoByTheirAgeOnly) {
  Open(WithFakeRun({.retention = {.age = hours(1)}}));
  const std::string brief = EndedJobName(60);
  const std::string usual = EndedJobName();
  const std::string lasting = EndedJobName(7200);
  const std::string running = Create();
  run_.AwaitStarted(4);
  const v1::Job job = Get(brief).value();
  EXPECT_EQ(job.expire_time().seconds(), job.end_time().seconds() + 60);
  EXPECT_EQ(Get(usual).value().expire_time().seconds(), job.end_time().seconds() + 3600);
  EXPECT_FALSE(Get(running).value().has_expire_time());

  Retention retention(*store_, clock_, {.age = hours(1)}, feed_);
  const auto reader = feed_.Subscribe(kLocal, [] {});
  clock_.Advance(seconds(59));
  EXPECT_EQ(retention.Purge(), 0);
  clock_.Advance(seconds(1));
  EXPECT_EQ(retention.Purge(), 1);
  EXPECT_FALSE(Get(brief).ok());
  EXPECT_THAT(reader->Take(10), ElementsAre(brief)) << "who watches all jobs hears of it";
  EXPECT_TRUE(Get(usual).ok());
  clock_.Advance(hours(100));
  EXPECT_EQ(retention.Purge(), 2);
  EXPECT_FALSE(Get(lasting).ok());
  EXPECT_EQ(Get(running).value().state(), v1::Job::RUNNING);
}

TEST_F(RetentionTest, NothingGoesUnlessSomeoneSaysSo) {
  OpenWithFakeRun();
  const std::string name = EndedJobName();
  EXPECT_FALSE(Get(name).value().has_expire_time());
  clock_.Advance(hours(24 * 365 * 10));
  EXPECT_EQ(Retention(*store_, clock_, {}, feed_).Purge(), 0);
  EXPECT_TRUE(Get(name).ok());
}

TEST_F(RetentionTest, FirstToEndGoWhenTheirBytesAreTooMany) {
  OpenWithFakeRun();
  const std::string first = EndedJobName();
  clock_.Advance(seconds(1));
  const std::string second = EndedJobName();
  Await<absl::StatusOr<std::vector<JobSize>>> sizes;
  store_->Sizes(sizes.callback());
  const std::vector<JobSize> stored = sizes.Get().value();
  ASSERT_EQ(stored.size(), 2u);
  const std::int64_t both = stored[0].bytes + stored[1].bytes;
  EXPECT_EQ(Retention(*store_, clock_, {.bytes = both}, feed_).Purge(), 0);
  EXPECT_EQ(Retention(*store_, clock_, {.bytes = both - 1}, feed_).Purge(), 1);
  EXPECT_FALSE(Get(first).ok());
  EXPECT_TRUE(Get(second).ok());
}

TEST_F(RetentionTest, AClockThatJumpsDeletesNothing) {
  Open(WithFakeRun());
  for (int i = 0; i < 3; ++i) EndedJobName();
  Retention retention(*store_, clock_, {.age = hours(720)}, feed_);
  clock_.Jump(hours(24 * 365));
  EXPECT_EQ(retention.Purge(), 0);
  clock_.Advance(hours(719));
  EXPECT_EQ(retention.Purge(), 0);
  clock_.Advance(hours(1));
  EXPECT_EQ(retention.Purge(), 3) << "but time that passes counts, whatever the clock says";
}

TEST_F(RetentionTest, ManyJobsGoPageByPage) {
  Open(WithFakeRun({.workers = 4}));
  for (int i = 0; i < 450; ++i) ASSERT_TRUE(Create(RequestFor(BouncingBall())).ok());
  run_.Allow(450);
  while (manager_->Info().queued_jobs() + manager_->Info().running_jobs() > 0) {
    std::this_thread::yield();
  }
  clock_.Advance(seconds(2));
  EXPECT_EQ(Retention(*store_, clock_, {.age = seconds(1)}, feed_).Purge(), 45) << "a tenth";
  EXPECT_EQ(Retention(*store_, clock_, {.bytes = 1}, feed_).Purge(), 405);
  EXPECT_EQ(List({}).value().jobs_size(), 0);
}

TEST_F(RetentionTest, TrajectoriesGoAndResultsStay) {
  Open({.retention = {.compact_after = hours(1)}});
  const std::string name = Create(BouncingBall(5));
  const v1::Job job = Ended(name);
  const std::size_t chunks = Log(name, 0, {"frame_chunk"}).size();
  ASSERT_GT(chunks, 1U);
  const auto events = Log(name, 0, {"cycle", "iteration"});
  Retention retention(*store_, clock_, {.compact_after = hours(1)}, feed_);
  retention.Purge();
  EXPECT_EQ(Get(name).value().oldest_sequence(), 1U) << "too soon";
  clock_.Advance(hours(1));
  retention.Purge();
  const v1::Job compacted = Get(name).value();
  EXPECT_EQ(compacted.oldest_sequence(), job.last_sequence());
  EXPECT_EQ(compacted.cycles_size(), job.cycles_size());
  EXPECT_EQ(Log(name, 0, {"cycle", "iteration"}).size(), events.size());
  EXPECT_EQ(compacted.groups_size(), job.groups_size());
  ASSERT_EQ(compacted.artifacts_size(), 2);
  EXPECT_EQ(compacted.artifacts(0).name(), "cycles.csv");
  EXPECT_EQ(compacted.artifacts(1).name(), "groups.csv");

  LogReader reader;
  const auto watched = Watch(name, reader);
  EXPECT_THAT(reader.ToEnd(*watched.value().cursor), IsEmpty());
  EXPECT_EQ(reader.end(), LogCursor::Next::kCompacted);
  EXPECT_EQ(watched.value().cursor->oldest(), job.last_sequence());
  EXPECT_EQ(Log(name, job.last_sequence() - 1).size(), 1U) << "what is left can be watched";

  v1::GetSeriesRequest request;
  request.set_name(name);
  Await<Result<v1::Series>> series;
  manager_->recordings().GetSeries(LocalPrincipal(), request, series.callback());
  const Result<v1::Series> answer = series.Get();
  EXPECT_EQ(answer.error().code, absl::StatusCode::kOutOfRange);
  EXPECT_EQ(answer.error().reason, "EVENTS_COMPACTED");
  EXPECT_EQ(answer.error().metadata.at("oldest_sequence"), std::to_string(job.last_sequence()));
}

}  // namespace
}  // namespace contact
