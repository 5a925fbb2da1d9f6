#include "jobs/log/jobs_cursor.h"

#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// One who watches the jobs of the manager.
class JobsCursorTest : public JobsTest {
 protected:
  Watches::Jobs Watch(v1::WatchJobsRequest request = {}) {
    request.mutable_bookmark_interval()->set_seconds(3600);
    return std::move(
        manager_->watches().WatchJobs(LocalPrincipal(), request, reader_.wake()).value());
  }
  // The next message, waiting for it.
  v1::WatchJobsResponse Next(StreamSource<v1::WatchJobsResponse>& cursor) {
    for (;;) {
      v1::WatchJobsResponse message;
      const StreamStep step = cursor.Read(&message);
      EXPECT_FALSE(step.error) << step.error->reason;
      if (step.has_message || step.error) return message;
      reader_.Wait();
    }
  }
  // Reads until the job is told in that state, and returns all names told.
  std::vector<std::string> UntilState(StreamSource<v1::WatchJobsResponse>& cursor,
                                      const std::string& name, v1::Job::State state) {
    std::vector<std::string> names;
    for (;;) {
      const v1::WatchJobsResponse message = Next(cursor);
      for (const v1::Job& job : message.jobs()) {
        names.push_back(job.name());
        if (job.name() == name && job.state() == state) return names;
      }
    }
  }
  static std::vector<std::string> Names(const v1::WatchJobsResponse& message) {
    std::vector<std::string> names;
    for (const v1::Job& job : message.jobs()) names.push_back(job.name());
    return names;
  }

  LogReader reader_;
};

TEST_F(JobsCursorTest, BeginsWithAllJobsNewestFirst) {
  OpenWithFakeRun();
  std::vector<std::string> names;
  for (int i = 0; i < 250; ++i) names.insert(names.begin(), Create());
  const auto cursor = Watch();
  std::vector<std::string> told;
  for (bool complete = false; !complete;) {
    const v1::WatchJobsResponse message = Next(*cursor);
    EXPECT_LE(message.jobs_size(), 100);
    for (const v1::Job& job : message.jobs()) EXPECT_EQ(job.spec_case(), v1::Job::SPEC_NOT_SET);
    for (const std::string& name : Names(message)) told.push_back(name);
    complete = message.snapshot_complete();
  }
  EXPECT_EQ(told, names);
}

TEST_F(JobsCursorTest, MessagesOfLargeJobsKeepToTheirBytes) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  for (int i = 0; i < 16; ++i) {
    (*request.mutable_job()->mutable_labels())["label-" + std::to_string(i)] = std::string(60, 'x');
  }
  for (int i = 0; i < 150; ++i) ASSERT_TRUE(Create(request).ok());
  // So many that 100 of these jobs are twice what a message may have.
  std::vector<Watches::Jobs> watchers;
  for (int i = 0; i < 400; ++i) watchers.push_back(Watch());
  int jobs = 0;
  while (jobs < 150) {
    const v1::WatchJobsResponse message = Next(*watchers.back());
    EXPECT_LE(message.ByteSizeLong(), MessageBytes(400));
    jobs += message.jobs_size();
  }
}

TEST_F(JobsCursorTest, EmptyServerAnswersAtOnce) {
  OpenWithFakeRun();
  const v1::WatchJobsResponse message = Next(*Watch());
  EXPECT_TRUE(message.snapshot_complete());
  EXPECT_THAT(Names(message), IsEmpty());
}

TEST_F(JobsCursorTest, TellsCreationEveryStateAndDeletion) {
  OpenWithFakeRun();
  const auto cursor = Watch();
  Next(*cursor);
  const std::string name = Create();
  UntilState(*cursor, name, v1::Job::RUNNING);
  run_.Allow();
  UntilState(*cursor, name, v1::Job::SUCCEEDED);
  EXPECT_TRUE(Delete(name).ok());
  EXPECT_THAT(Next(*cursor).gone(), ElementsAre(name));
}

TEST_F(JobsCursorTest, JobThatLeavesTheStatesAskedForIsGone) {
  Open(WithFakeRun({.workers = 1}));
  Create();
  run_.AwaitStarted(1);
  const std::string waiting = Create();
  v1::WatchJobsRequest request;
  request.add_states(v1::Job::QUEUED);
  const auto cursor = Watch(request);
  EXPECT_THAT(Names(Next(*cursor)), ElementsAre(waiting));
  EXPECT_TRUE(Cancel(waiting).ok());
  EXPECT_THAT(Next(*cursor).gone(), ElementsAre(waiting));
}

TEST_F(JobsCursorTest, OtherLabelsAreNotTold) {
  OpenWithFakeRun();
  v1::WatchJobsRequest request;
  (*request.mutable_labels())["study"] = "a";
  const auto cursor = Watch(request);
  Next(*cursor);
  Create();
  v1::CreateJobRequest wanted = RequestFor(BouncingBall());
  (*wanted.mutable_job()->mutable_labels())["study"] = "a";
  const std::string name = Create(wanted).value().name();
  EXPECT_THAT(Names(Next(*cursor)), ElementsAre(name));
}

TEST_F(JobsCursorTest, WhoReadsLateHearsTheNewestOfEachJobOnce) {
  OpenWithFakeRun();
  const auto cursor = Watch();
  Next(*cursor);
  const std::string first = Create();
  const std::string second = Create();
  run_.Allow(2);
  Ended(first);
  Ended(second);
  const v1::WatchJobsResponse message = Next(*cursor);
  EXPECT_THAT(Names(message), UnorderedElementsAre(first, second));
  for (const v1::Job& job : message.jobs()) EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
  v1::WatchJobsResponse none;
  EXPECT_FALSE(cursor->Read(&none).has_message);
}

TEST_F(JobsCursorTest, MessageWithoutJobsComesOnceAnInterval) {
  OpenWithFakeRun();
  const auto cursor = Watch();
  Next(*cursor);
  v1::WatchJobsResponse message;
  EXPECT_FALSE(cursor->IsDue(clock_.Elapsed()));
  EXPECT_FALSE(cursor->Read(&message).has_message);
  clock_.Advance(std::chrono::hours(1));
  EXPECT_TRUE(cursor->IsDue(clock_.Elapsed()));
  EXPECT_TRUE(cursor->Read(&message).has_message);
  EXPECT_TRUE(message.snapshot_complete());
  EXPECT_THAT(Names(message), IsEmpty());
  EXPECT_FALSE(cursor->Read(&message).has_message);
}

TEST_F(JobsCursorTest, ReaderThatFallsBehindAllBoundsIsToldSo) {
  OpenWithFakeRun();
  JobFeed feed;
  JobsCursor cursor(
      *store_, feed, clock_, {{}, std::chrono::hours(1), kLocal}, [](StoredJob*) {}, reader_.wake(),
      nullptr);
  Next(cursor);
  for (std::size_t i = 0; i <= JobFeed::kMostChanges; ++i) {
    feed.Changed(kLocal, "jobs/" + std::to_string(i));
  }
  v1::WatchJobsResponse message;
  const StreamStep step = cursor.Read(&message);
  EXPECT_FALSE(step.has_message);
  ASSERT_TRUE(step.error);
  EXPECT_EQ(step.error->reason, "SLOW_WATCHER");
}

TEST(JobFeed, IsWatchedWhileItHasReaders) {
  JobFeed feed;
  EXPECT_FALSE(feed.watched());
  auto reader = feed.Subscribe("acme", [] {});
  EXPECT_TRUE(feed.watched());
  reader = nullptr;
  EXPECT_FALSE(feed.watched());
}

TEST(JobFeed, KeepsEachNameOnceAndNotTooMany) {
  JobFeed feed;
  const auto reader = feed.Subscribe(kLocal, [] {});
  for (int i = 0; i < 100'000; ++i) feed.Changed(kLocal, "jobs/a");
  EXPECT_THAT(reader->Take(10), ElementsAre("jobs/a"));
  for (std::size_t i = 0; i < JobFeed::kMostChanges; ++i)
    feed.Changed(kLocal, "jobs/" + std::to_string(i));
  EXPECT_FALSE(reader->overflown());
  feed.Changed(kLocal, "jobs/b");
  EXPECT_TRUE(reader->overflown());
  EXPECT_THAT(reader->Take(10), IsEmpty());
}

TEST(JobFeed, WakesOnceForWhatIsNotLookedAt) {
  JobFeed feed;
  int wakes = 0;
  const auto reader = feed.Subscribe(kLocal, [&wakes] { ++wakes; });
  feed.Changed(kLocal, "jobs/a");
  feed.Changed(kLocal, "jobs/b");
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(reader->Take(1).size(), 1U);
  feed.Changed(kLocal, "jobs/c");
  EXPECT_EQ(wakes, 1) << "it still has something to look at";
  EXPECT_EQ(reader->Take(9).size(), 2U);
  EXPECT_TRUE(reader->Take(9).empty());
  feed.Changed(kLocal, "jobs/d");
  EXPECT_EQ(wakes, 2);
}

TEST_F(JobsCursorTest, NewLabelsBringAndTakeAJob) {
  OpenWithFakeRun();
  const std::string name = Create();
  v1::WatchJobsRequest request;
  (*request.mutable_labels())["law"] = "x";
  const auto cursor = Watch(request);
  EXPECT_THAT(Names(Next(*cursor)), IsEmpty());
  ASSERT_TRUE(Relabel(name, "law", "x").ok());
  for (v1::WatchJobsResponse message; Names(message).empty(); message = Next(*cursor)) {
    EXPECT_THAT(message.gone(), testing::Each(name)) << "as its run goes on";
  }
  ASSERT_TRUE(Relabel(name, "law", "y").ok());
  v1::WatchJobsResponse last;
  while (last.gone().empty()) last = Next(*cursor);
  EXPECT_THAT(last.gone(), ElementsAre(name));
}

}  // namespace
}  // namespace contact
