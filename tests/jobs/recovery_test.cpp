// What a manager makes of what an earlier one has left.
#include <SQLiteCpp/SQLiteCpp.h>

#include "jobs/job/lifecycle.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;

std::vector<std::string> Story(const std::vector<v1::Event>& log) {
  std::vector<std::string> story;
  for (const v1::Event& event : log) {
    if (event.has_state_changed()) {
      const v1::StateChanged& changed = event.state_changed();
      story.push_back(v1::Job::State_Name(changed.state()) + " " + changed.state_reason());
    } else if (event.has_attempt_started()) {
      story.push_back("attempt " + std::to_string(event.attempt_started().attempt()));
    }
  }
  return story;
}

class RecoveryTest : public JobsTest {};

TEST_F(RecoveryTest, JobsGoOnAfterACrash) {
  OpenWithFakeRun();
  const std::string running = Create();
  run_.AwaitStarted(1);
  const std::string queued = Create();
  EXPECT_EQ(Get(running).value().state(), v1::Job::RUNNING);  // So it is stored.
  Crash();
  OpenWithFakeRun();
  run_.Allow(2);
  EXPECT_EQ(Ended(running).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(running).attempt(), 2);
  EXPECT_EQ(Ended(queued).state(), v1::Job::SUCCEEDED);
  EXPECT_THAT(Story(Log(running)),
              ElementsAre("QUEUED WAITING_FOR_WORKER", "RUNNING ", "attempt 1",
                          "QUEUED SERVER_RESTARTED", "RUNNING ", "attempt 2", "SUCCEEDED "));
  EXPECT_THAT(Story(Log(queued)),
              ElementsAre("QUEUED WAITING_FOR_WORKER", "RUNNING ", "attempt 1", "SUCCEEDED "));
}

TEST_F(RecoveryTest, QueueKeepsItsOrder) {
  std::vector<double> order;
  FakeRun run([&](const Scenario& scenario, Observer&, const std::stop_token&) {
    order.push_back(scenario.end_time);
    return Outcome{};
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  std::string last;
  for (const double end_time : {1.0, 2.0, 3.0, 4.0}) last = Create(BouncingBall(end_time));
  run.AwaitStarted(1);
  Crash();
  Open(options);
  run.Allow(4);
  Ended(last);
  EXPECT_THAT(order, ElementsAre(1, 2, 3, 4));
}

TEST_F(RecoveryTest, StopPutsRunningJobsBackWithoutCountingTheAttempt) {
  OpenWithFakeRun();
  const std::string name = Create();
  run_.AwaitStarted(1);
  manager_->Stop();
  OpenWithFakeRun();
  run_.Allow();
  EXPECT_EQ(Ended(name).attempt(), 1);
  EXPECT_THAT(Story(Log(name)),
              ElementsAre("QUEUED WAITING_FOR_WORKER", "RUNNING ", "attempt 1",
                          "QUEUED SERVER_RESTARTED", "RUNNING ", "attempt 1", "SUCCEEDED "));
}

TEST_F(RecoveryTest, WishToCancelSurvivesACrash) {
  std::promise<void> release;
  const auto released = release.get_future().share();
  JobOptions options;
  std::promise<void> started;
  options.run = [&](const Scenario&, Observer&, const std::stop_token&) {
    started.set_value();
    released.wait();  // Does not look at the stop token.
    return Ending(Outcome::End::kStopped);
  };
  Open(options);
  const std::string name = Create();
  started.get_future().wait();
  ASSERT_TRUE(Cancel(name).ok());
  TempDirectory image;
  for (const char* file : {"contactd.db", "contactd.db-wal", "initialised"}) {
    std::filesystem::copy(directory_.path() / file, image.path() / file);
  }
  release.set_value();
  EXPECT_EQ(Ended(name).state(), v1::Job::CANCELLED);

  const auto store = *OpenSqlite(image.path());
  JobManager manager(*store, clock_, ids_, WithFakeRun());
  Await<Result<v1::Job>> job;
  manager.reader().Get(LocalPrincipal(), name, job.callback());
  const v1::Job recovered = job.Get().value();
  EXPECT_EQ(recovered.state(), v1::Job::CANCELLED);
  EXPECT_EQ(recovered.state_reason(), "USER_REQUEST");
  EXPECT_EQ(run_.started(), 0);
}

TEST_F(RecoveryTest, RequestIdIsKnownAfterARestart) {
  OpenWithFakeRun();
  const std::string name = Create(RequestFor(BouncingBall(), "id")).value().name();
  OpenWithFakeRun();
  EXPECT_EQ(Create(RequestFor(BouncingBall(), "id")).value().name(), name);
}

TEST_F(RecoveryTest, WatcherGoesOnAcrossARestart) {
  OpenWithFakeRun();
  const std::string name = Create();
  run_.AwaitStarted(1);
  std::vector<std::uint64_t> sequences;
  {
    LogReader reader;
    const auto watched = Watch(name, reader);
    while (sequences.size() < 3) {
      for (const v1::Event& event : reader.Next(*watched.value().cursor)) {
        sequences.push_back(event.sequence());
      }
    }
  }
  Crash();
  OpenWithFakeRun();
  run_.Allow();
  for (const v1::Event& event : Log(name, sequences.back())) sequences.push_back(event.sequence());
  EXPECT_THAT(sequences, ElementsAre(1, 2, 3, 4, 5, 6, 7));
}

TEST_F(RecoveryTest, RunsAgainToTheSameResult) {
  Open();
  const v1::Job once = Ended(Create(BouncingBall(20)));
  const std::string name = Create(BouncingBall(20));
  LogReader reader;
  auto watched = Watch(name, reader, 0, {"cycle"});
  while (reader.Next(*watched.value().cursor).empty()) {
  }
  watched.value().cursor.reset();
  Crash();
  Open();
  const v1::Job again = Ended(name);
  ASSERT_EQ(again.cycles_size(), once.cycles_size());
  for (int i = 0; i < once.cycles_size(); ++i) {
    EXPECT_EQ(again.cycles(i).SerializeAsString(), once.cycles(i).SerializeAsString());
  }
}

TEST_F(RecoveryTest, DamagedSpecFailsItsJobOnly) {
  OpenWithFakeRun();
  const std::string first = Create();
  run_.AwaitStarted(1);
  const std::string bad = Create();
  const std::string good = Create();
  Crash();
  SQLite::Database(directory_.path() / "contactd.db", SQLite::OPEN_READWRITE)
      .exec("UPDATE specs SET spec=zeroblob(5) WHERE job=2");
  OpenWithFakeRun();
  run_.Allow(2);
  EXPECT_EQ(Ended(first).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(good).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Get(bad).error().reason, "DATA_LOSS");
  v1::ListJobsRequest failed;
  failed.add_states(v1::Job::FAILED);
  const v1::ListJobsResponse listed = List(failed).value();
  ASSERT_EQ(listed.jobs_size(), 1);
  EXPECT_EQ(listed.jobs(0).name(), bad);
  EXPECT_EQ(listed.jobs(0).state_reason(), "INTERNAL");
}

}  // namespace
}  // namespace contact
