#include "jobs/retention.h"

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
    const std::string name = Create(request).value().name();
    Ended(name);
    return name;
  }
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

  Retention retention(*store_, clock_, {.age = hours(1)});
  clock_.Advance(seconds(59));
  EXPECT_EQ(retention.Sweep(), 0);
  clock_.Advance(seconds(1));
  EXPECT_EQ(retention.Sweep(), 1);
  EXPECT_FALSE(Get(brief).ok());
  EXPECT_TRUE(Get(usual).ok());
  clock_.Advance(hours(100));
  EXPECT_EQ(retention.Sweep(), 2);
  EXPECT_FALSE(Get(lasting).ok());
  EXPECT_EQ(Get(running).value().state(), v1::Job::RUNNING);
}

TEST_F(RetentionTest, NothingGoesUnlessSomeoneSaysSo) {
  OpenWithFakeRun();
  const std::string name = EndedJobName();
  EXPECT_FALSE(Get(name).value().has_expire_time());
  clock_.Advance(hours(24 * 365 * 10));
  EXPECT_EQ(Retention(*store_, clock_, {}).Sweep(), 0);
  EXPECT_TRUE(Get(name).ok());
}

TEST_F(RetentionTest, ManyJobsGoPageByPage) {
  Open(WithFakeRun({.workers = 4}));
  for (int i = 0; i < 450; ++i) ASSERT_TRUE(Create(RequestFor(BouncingBall())).ok());
  run_.Allow(450);
  while (manager_->Info().queued_jobs() + manager_->Info().running_jobs() > 0) {
    std::this_thread::yield();
  }
  clock_.Advance(seconds(2));
  EXPECT_EQ(Retention(*store_, clock_, {.age = seconds(1)}).Sweep(), 450);
  EXPECT_EQ(List({}).value().jobs_size(), 0);
}

}  // namespace
}  // namespace contact
