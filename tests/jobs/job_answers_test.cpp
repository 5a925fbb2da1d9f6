// What answers about jobs hold, and what they leave out.
#include <pthread.h>

#include <array>
#include <string>

#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::HasSubstr;

// It would hold up the commits of others.
TEST_F(JobsTest, LedgerIsNotParsedOnTheStoresThread) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnCycle({});
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string name = Create(BouncingBall());
  Ended(name);
  Await<std::string> thread;
  manager_->reader().Get(LocalPrincipal(), name,
                         [told = thread.callback()](const Result<v1::Job>& job) {
                           EXPECT_EQ(job.value().cycles_size(), 1);
                           std::array<char, 16> own{};
                           pthread_getname_np(pthread_self(), own.data(), own.size());
                           told(own.data());
                         });
  EXPECT_EQ(thread.Get(), "checker");
}

TEST_F(JobsTest, LongLedgerIsShortenedInAnswers) {
  constexpr int kCycles = 100'000;
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    for (int i = 1; i <= kCycles; ++i) {
      observer.OnCycle({.number = i, .group = i});
      observer.OnGroup({.number = i, .first_cycle = i, .cycles = 1});
    }
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string name = Create(BouncingBall());
  Ended(name);
  const v1::Job job = Get(name).value();
  EXPECT_LT(job.ByteSizeLong(), 4U << 20);
  EXPECT_GT(job.cycles_size(), 1000);
  EXPECT_LT(job.cycles_size(), kCycles);
  EXPECT_GT(job.groups_size(), 1000);
  EXPECT_LT(job.groups_size(), kCycles);
  ASSERT_GT(job.warnings_size(), 1);
  EXPECT_THAT(job.warnings(job.warnings_size() - 2), HasSubstr("of 100000 cycles"));
  EXPECT_THAT(job.warnings(job.warnings_size() - 1), HasSubstr("of 100000 groups"));
}

TEST_F(JobsTest, TitleIsToldWhereTheSpecIsLeftOut) {
  Open();
  v1::Scenario ball = BouncingBall(1);
  ball.set_title("One ball");
  v1::CreateJobRequest request = RequestFor(ball);
  request.mutable_job()->set_title("the client cannot say so");
  const v1::Job created = Create(request).value();
  EXPECT_EQ(created.title(), "One ball");
  EXPECT_EQ(Ended(created.name()).title(), "One ball");
  v1::ListJobsRequest by_name;
  by_name.set_name_prefix(created.name().substr(0, created.name().size() - 1));
  const v1::ListJobsResponse found = List(by_name).value();
  ASSERT_EQ(found.jobs_size(), 1);
  EXPECT_EQ(found.jobs(0).title(), "One ball");
  Crash();
  Open();
  EXPECT_EQ(List({}).value().jobs(0).title(), "One ball");
}

TEST_F(JobsTest, ListLeavesOutWhatIsLarge) {
  Open();
  Ended(Create(BouncingBall(1)));
  v1::CreateJobRequest labelled = RequestFor(BouncingBall());
  (*labelled.mutable_job()->mutable_labels())["study"] = "a";
  const std::string second = Create(labelled).value().name();
  const v1::ListJobsResponse all = List({}).value();
  ASSERT_EQ(all.jobs_size(), 2);
  EXPECT_EQ(all.jobs(0).name(), second) << "newest first";
  EXPECT_EQ(all.jobs(0).labels().at("study"), "a");
  EXPECT_EQ(all.jobs(1).state(), v1::Job::SUCCEEDED);
  EXPECT_TRUE(all.jobs(1).has_summary());
  for (const v1::Job& job : all.jobs()) {
    EXPECT_FALSE(job.has_scenario());
    EXPECT_EQ(job.cycles_size() + job.final_bodies_size(), 0);
  }
  v1::ListJobsRequest page;
  page.set_page_size(1);
  const v1::ListJobsResponse first_page = List(page).value();
  page.set_page_token(first_page.next_page_token());
  EXPECT_EQ(List(page).value().jobs(0).name(), all.jobs(1).name());
  EXPECT_EQ(List(page).value().next_page_token(), "");
}

TEST_F(JobsTest, PageTokenIsGoodAfterARestartWithTheSameSecret) {
  const JobOptions options = WithFakeRun({.page_secret = "secret"});
  Open(options);
  const std::string first = Create();
  Create();
  v1::ListJobsRequest page;
  page.set_page_size(1);
  page.set_page_token(List(page).value().next_page_token());
  Open(options);
  EXPECT_EQ(List(page).value().jobs(0).name(), first);
  OpenWithFakeRun();
  EXPECT_EQ(List(page).error().reason, "FIELD_INVALID");
}

TEST_F(JobsTest, SnapshotHasTheJobWithoutItsLedger) {
  Open();
  const v1::Job job = Ended(Create(BouncingBall(1)));
  LogReader reader;
  const auto watched = Watch(job.name(), reader);
  const v1::Job& snapshot = watched.value().snapshot;
  EXPECT_EQ(snapshot.state(), v1::Job::SUCCEEDED);
  EXPECT_TRUE(snapshot.has_scenario());
  EXPECT_EQ(snapshot.cycles_size(), 0);
}

TEST_F(JobsTest, InfoTellsTheLimits) {
  Open(WithFakeRun({.workers = 2, .max_queued_jobs = 5, .max_watchers = 6}));
  Create();
  Create();
  Create();
  run_.AwaitStarted(2);
  const v1::ServerInfo info = manager_->Info();
  EXPECT_EQ(info.workers(), 2);
  EXPECT_EQ(info.running_jobs(), 2);
  EXPECT_EQ(info.queued_jobs(), 1);
  EXPECT_EQ(info.limits().max_queued_jobs(), 5);
  EXPECT_EQ(info.limits().max_watchers(), 6);
  EXPECT_EQ(info.limits().max_bodies(), ScenarioLimits().max_bodies);
}

}  // namespace
}  // namespace contact
