#include "jobs/job_manager.h"

#include <sys/resource.h>

#include <set>

#include "jobs/job/lifecycle.h"
#include "jobs_fixture.h"
#include "wire/spec_digest.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<v1::Job::State> States(const std::vector<v1::Event>& log) {
  std::vector<v1::Job::State> states;
  for (const v1::Event& event : log) {
    if (event.has_state_changed()) states.push_back(event.state_changed().state());
  }
  return states;
}

TEST_F(JobsTest, CreateIsDurableBeforeItIsAnswered) {
  OpenWithFakeRun();
  Await<Result<v1::Job>> created;
  std::filesystem::path image = directory_.path() / "image";
  manager_->creator().Create(
      LocalPrincipal(), RequestFor(BouncingBall()), [&, done = created.callback()](auto job) {
        // What a crash at this moment would leave.
        std::filesystem::create_directory(image);
        for (const char* file : {"contactd.db", "contactd.db-wal", "initialised"}) {
          std::filesystem::copy(directory_.path() / file, image / file);
        }
        done(std::move(job));
      });
  const v1::Job job = created.Get().value();
  EXPECT_EQ(job.state(), v1::Job::QUEUED);
  EXPECT_EQ(job.state_reason(), "WAITING_FOR_WORKER");
  EXPECT_EQ(job.last_sequence(), 1U);
  EXPECT_TRUE(job.has_scenario());
  const auto store = *OpenSqlite(image);
  Await<absl::StatusOr<StoredJob>> stored;
  store->Read(job.name(), JobPart::kAll, stored.callback());
  const auto survived = stored.Get();
  ASSERT_TRUE(survived.ok()) << survived.status();
  EXPECT_EQ(survived->job.SerializeAsString(), job.SerializeAsString());
}

TEST_F(JobsTest, JobRunsToItsResult) {
  Open();
  const v1::Job job = Ended(Create(BouncingBall(2)));
  EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(job.convergence(), v1::Job::FULL);
  EXPECT_EQ(job.attempt(), 1);
  EXPECT_GT(job.cycles_size(), 3);
  EXPECT_EQ(job.final_bodies_size(), 1);
  EXPECT_GT(job.summary().steps(), 0);
  EXPECT_GT(job.summary().wall_time_s(), 0);
  EXPECT_FALSE(job.server_version().empty());
  EXPECT_EQ(job.spec_sha256(), SpecSha256(job));
  EXPECT_TRUE(job.has_scenario());
  EXPECT_FALSE(job.progress().steps() == 0);

  const auto log = Log(job.name());
  EXPECT_EQ(log.size(), job.last_sequence());
  EXPECT_THAT(States(log), ElementsAre(v1::Job::QUEUED, v1::Job::RUNNING, v1::Job::SUCCEEDED));
  EXPECT_EQ(log[2].attempt_started().attempt(), 1);
  EXPECT_EQ(log.back().state_changed().convergence(), v1::Job::FULL);
  int cycles = 0, groups = 0;
  for (const v1::Event& event : log) {
    cycles += event.has_cycle();
    groups += event.has_group();
  }
  EXPECT_EQ(cycles, job.cycles_size());
  EXPECT_EQ(groups, job.groups_size());
  EXPECT_EQ(groups, cycles) << "each bounce is a group of its own";
}

TEST_F(JobsTest, GrowthsAreEventsAndNoPartOfTheResult) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnGrowth({.first_cycle = 2, .cycles = 1, .growth = Growth::kTooLittle});
    Outcome outcome;
    outcome.growths = 1;
    return outcome;
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const v1::Job job = Ended(Create(BouncingBall(2)));
  EXPECT_EQ(job.groups_size(), 0);
  EXPECT_EQ(job.summary().growths(), 1);
  const auto log = Log(job.name(), 0, {"group_growth"});
  const auto growth = std::ranges::find_if(log, &v1::Event::has_group_growth);
  ASSERT_NE(growth, log.end());
  EXPECT_EQ(growth->group_growth().contact(), "ball-wall");
  EXPECT_EQ(growth->group_growth().first_cycle(), 2);
  EXPECT_EQ(growth->group_growth().growth(), v1::Group::TOO_LITTLE);
}

TEST_F(JobsTest, ScenarioIsCheckedWithAllElseAtOnce) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = RequestFor(BouncingBall(-1), "\x01");
  request.mutable_job()->mutable_scenario()->mutable_bodies(0)->set_mass_kg(-1);
  const auto refused = Create(request);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(refused.error().reason, "SCENARIO_INVALID");
  std::vector<std::string> fields;
  for (const Violation& violation : refused.error().violations) fields.push_back(violation.field);
  EXPECT_THAT(fields,
              ElementsAre("request_id", "scenario.bodies[0].mass_kg", "scenario.end_time_s"));
  EXPECT_EQ(List({}).value().jobs_size(), 0);
}

TEST_F(JobsTest, BadRequestWithGoodScenarioIsFieldInvalid) {
  OpenWithFakeRun();
  EXPECT_EQ(Create(RequestFor(BouncingBall(), "\x01")).error().reason, "FIELD_INVALID");
  EXPECT_EQ(Create(v1::CreateJobRequest()).error().reason, "FIELD_INVALID");
}

TEST_F(JobsTest, ValidateOnlyStoresNothing) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = RequestFor(BouncingBall(), "id");
  request.set_validate_only(true);
  const v1::Job job = Create(request).value();
  EXPECT_EQ(job.name(), "");
  EXPECT_EQ(job.state(), v1::Job::STATE_UNSPECIFIED);
  EXPECT_EQ(List({}).value().jobs_size(), 0);
  request.mutable_job()->mutable_scenario()->set_end_time_s(-1);
  EXPECT_EQ(Create(request).error().reason, "SCENARIO_INVALID");
}

TEST_F(JobsTest, NothingIsStoredForACallerThatHasLeft) {
  OpenWithFakeRun();
  Await<Result<v1::Job>> left;
  manager_->creator().Create(LocalPrincipal(), RequestFor(BouncingBall()), left.callback(),
                             [] { return true; });
  EXPECT_EQ(left.Get().error().reason, "DEADLINE_EXCEEDED");
  Await<Result<v1::Job>> stayed;
  manager_->creator().Create(LocalPrincipal(), RequestFor(BouncingBall()), stayed.callback(),
                             [] { return false; });
  EXPECT_TRUE(stayed.Get().ok());
  EXPECT_EQ(List({}).value().jobs_size(), 1);
}

TEST_F(JobsTest, OutputFieldsOfTheRequestAreIgnored) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  request.mutable_job()->set_name("jobs/mine");
  request.mutable_job()->set_state(v1::Job::SUCCEEDED);
  request.mutable_job()->add_cycles();
  const v1::Job job = Create(request).value();
  EXPECT_EQ(job.name(), "jobs/a1");
  EXPECT_EQ(job.cycles_size(), 0);
}

TEST_F(JobsTest, RequestIdMakesOneJobHoweverOftenItIsSent) {
  OpenWithFakeRun();
  constexpr int kTries = 200;
  std::vector<Await<Result<v1::Job>>> answers(kTries);
  for (auto& answer : answers) {
    manager_->creator().Create(LocalPrincipal(), RequestFor(BouncingBall(), "again"),
                               answer.callback());
  }
  std::set<std::string> names;
  for (auto& answer : answers) names.insert(answer.Get().value().name());
  EXPECT_EQ(names.size(), 1U);
  EXPECT_EQ(List({}).value().jobs_size(), 1);
  const auto other = Create(RequestFor(BouncingBall(7), "again"));
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().code, absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(other.error().reason, "REQUEST_ID_REUSED");
  v1::CreateJobRequest labelled = RequestFor(BouncingBall(), "again");
  (*labelled.mutable_job()->mutable_labels())["a"] = "b";
  EXPECT_EQ(Create(labelled).error().reason, "REQUEST_ID_REUSED");
}

TEST_F(JobsTest, QueueTakesItsLimitAndNotOneMore) {
  Open(WithFakeRun({.max_queued_jobs = 3}));
  const std::string running = Create();
  run_.AwaitStarted(1);
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(Create(RequestFor(BouncingBall())).ok());
  ASSERT_TRUE(Create(RequestFor(BouncingBall(), "third")).ok());
  const auto refused = Create(RequestFor(BouncingBall()));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(refused.error().reason, "QUEUE_FULL");
  EXPECT_GT(refused.error().retry_after.count(), 0);
  EXPECT_EQ(Create(RequestFor(BouncingBall(), "fourth")).error().reason, "QUEUE_FULL");
  EXPECT_TRUE(Create(RequestFor(BouncingBall(), "third")).ok()) << "a repeated request is answered";
  EXPECT_EQ(manager_->Info().queued_jobs(), 3);
  run_.Allow();
  run_.AwaitStarted(2);
  EXPECT_TRUE(Create(RequestFor(BouncingBall())).ok());
}

TEST_F(JobsTest, RefusedJobsKeepNoPlaceInTheQueue) {
  Open(WithFakeRun({.max_queued_jobs = 1}));
  Create();
  run_.AwaitStarted(1);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(Create(RequestFor(BouncingBall(-1))).ok());
  EXPECT_TRUE(Create(RequestFor(BouncingBall(), "id")).ok());
  EXPECT_TRUE(Create(RequestFor(BouncingBall(), "id")).ok());
  EXPECT_EQ(manager_->Info().queued_jobs(), 1);
}

TEST_F(JobsTest, FullStoreRefusesJobsAndTellsTheOthers) {
  Open(WithFakeRun(), {.max_bytes = 300'000});
  const std::string first = Create();
  run_.AwaitStarted(1);
  int accepted = 0;
  Result<v1::Job> last = Create(RequestFor(BouncingBall()));
  for (; last.ok() && accepted < 1000; ++accepted) last = Create(RequestFor(BouncingBall()));
  ASSERT_FALSE(last.ok());
  EXPECT_EQ(last.error().code, absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(last.error().reason, "STORE_FULL");
  EXPECT_GT(last.error().retry_after.count(), 0);
  EXPECT_TRUE(Get(first).ok());
  EXPECT_EQ(manager_->Info().queued_jobs(), accepted) << "what was refused has no place";
}

// Every thread here began as nice as this one.
TEST_F(JobsTest, RunsStepBackBehindWhoeverAnswersCalls) {
  int niceness = 0;
  FakeRun run([&](const auto&...) {
    niceness = getpriority(PRIO_PROCESS, 0);
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  Ended(Create(BouncingBall()));
  EXPECT_GT(niceness, getpriority(PRIO_PROCESS, 0));
}

TEST_F(JobsTest, JobsRunFirstComeFirstServed) {
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
  run.Allow(4);
  Ended(last);
  EXPECT_THAT(order, ElementsAre(1, 2, 3, 4));
}

TEST_F(JobsTest, CancelWhileQueuedNeverRuns) {
  OpenWithFakeRun();
  const std::string blocker = Create();
  run_.AwaitStarted(1);
  const std::string queued = Create();
  const std::string after = Create();
  const v1::Job job = Cancel(queued).value();
  EXPECT_EQ(job.state(), v1::Job::CANCELLED);
  EXPECT_EQ(job.state_reason(), "USER_REQUEST");
  EXPECT_EQ(job.attempt(), 0);
  run_.Allow(2);
  Ended(after);
  EXPECT_EQ(run_.started(), 2);
  EXPECT_THAT(States(Log(queued)), ElementsAre(v1::Job::QUEUED, v1::Job::CANCELLED));
}

TEST_F(JobsTest, CancelStopsARealRunAndKeepsWhatItBrought) {
  Open();
  const std::string name = Create();
  LogReader reader;
  const auto watched = Watch(name, reader, 0, {"cycle"});
  std::vector<v1::Event> log;
  while (log.size() < 5) {
    for (const v1::Event& event : reader.Next(*watched.value().cursor)) log.push_back(event);
  }
  EXPECT_GT(Get(name).value().cycles_size(), 0) << "the ledger so far";
  ASSERT_TRUE(Cancel(name).ok());
  const v1::Job job = Ended(name);
  EXPECT_EQ(job.state(), v1::Job::CANCELLED);
  EXPECT_EQ(job.state_reason(), "USER_REQUEST");
  EXPECT_EQ(job.convergence(), v1::Job::CONVERGENCE_UNSPECIFIED);
  EXPECT_GE(job.cycles_size(), 3);
  EXPECT_GT(job.summary().time_reached_s(), 0);
}

TEST_F(JobsTest, CancelOfAnEndedJobChangesNothing) {
  OpenWithFakeRun();
  run_.Allow();
  const v1::Job ended = Ended(Create());
  EXPECT_EQ(Cancel(ended.name()).value().SerializeAsString(), ended.SerializeAsString());
}

TEST_F(JobsTest, UpdateChangesWhatTheMaskNamesInAnyState) {
  OpenWithFakeRun();
  const std::string name = Create();
  v1::UpdateJobRequest request;
  request.mutable_job()->set_name(name);
  (*request.mutable_job()->mutable_labels())["law"] = "x";
  request.mutable_job()->set_note("a\nβ");
  request.mutable_update_mask()->add_paths("note");
  EXPECT_EQ(Update(request).value().labels_size(), 0);
  request.mutable_update_mask()->clear_paths();
  EXPECT_EQ(Update(request).value().labels().at("law"), "x");
  run_.Allow();
  Ended(name);
  EXPECT_EQ(Get(name).value().note(), "a\nβ");
  request.mutable_job()->clear_note();
  request.mutable_job()->clear_labels();
  request.mutable_update_mask()->add_paths("*");
  const v1::Job job = Update(request).value();
  EXPECT_EQ(job.note(), "");
  EXPECT_EQ(job.labels_size(), 0);
  EXPECT_EQ(job.state(), v1::Job::SUCCEEDED);
}

TEST_F(JobsTest, CallsOnAMissingJobAreNotFound) {
  OpenWithFakeRun();
  LogReader reader;
  for (const std::string name : {"jobs/none", "", "x'; DROP TABLE jobs; --"}) {
    EXPECT_EQ(Get(name).error().reason, "JOB_NOT_FOUND");
    EXPECT_EQ(Cancel(name).error().code, absl::StatusCode::kNotFound);
    EXPECT_EQ(Delete(name).error().reason, "JOB_NOT_FOUND");
    EXPECT_EQ(Watch(name, reader).error().reason, "JOB_NOT_FOUND");
  }
}

TEST_F(JobsTest, OnlyEndedJobsAreDeleted) {
  OpenWithFakeRun();
  const std::string running = Create();
  run_.AwaitStarted(1);
  const std::string queued = Create();
  for (const std::string& name : {running, queued}) {
    EXPECT_EQ(Delete(name).error().code, absl::StatusCode::kFailedPrecondition);
    EXPECT_EQ(Delete(name).error().reason, "INVALID_STATE");
  }
  Cancel(queued);
  EXPECT_TRUE(Delete(queued).ok());
  EXPECT_EQ(Get(queued).error().reason, "JOB_NOT_FOUND");
}

TEST_F(JobsTest, AnotherJobThanTheOneExpectedIsLeftAlone) {
  OpenWithFakeRun();
  const std::string running = Create();
  run_.AwaitStarted(1);
  const std::string queued = Create();
  const std::string uid = Get(queued).value().uid();
  ASSERT_FALSE(uid.empty());
  EXPECT_NE(uid, Get(running).value().uid());
  for (const std::string& name : {running, queued}) {
    const Error error = Cancel(name, "other").error();
    EXPECT_EQ(error.code, absl::StatusCode::kFailedPrecondition);
    EXPECT_EQ(error.reason, "UID_MISMATCH");
    EXPECT_EQ(error.metadata.at("uid"), Get(name).value().uid());
  }
  run_.Allow(2);
  EXPECT_EQ(Ended(running).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(queued).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Cancel(queued, "other").error().reason, "UID_MISMATCH") << "it has ended";
  EXPECT_EQ(Delete(queued, "other").error().reason, "UID_MISMATCH");
  EXPECT_EQ(Delete(queued, "other").error().metadata.at("uid"), uid);
  EXPECT_TRUE(Cancel(queued, uid).ok());
  EXPECT_TRUE(Delete(queued, uid).ok());
}

TEST_F(JobsTest, JobOfTheSameNameElsewhereIsNotTakenForThisOne) {
  OpenWithFakeRun();
  const std::string name = Create();
  const std::string uid = Get(name).value().uid();
  run_.Allow();
  Ended(name);
  ASSERT_TRUE(Delete(name, uid).ok());
  ids_.StartNamesAnew();
  const std::string again = Create();
  ASSERT_EQ(again, name);
  EXPECT_EQ(Cancel(name, uid).error().reason, "UID_MISMATCH");
  LogReader reader;
  v1::WatchJobRequest request;
  request.set_name(name);
  request.set_expected_uid(uid);
  EXPECT_EQ(Watch(request, reader).error().reason, "UID_MISMATCH");
}

TEST_F(JobsTest, WorkerTakesTheNextJobWhileTheEndOfTheLastIsStored) {
  OpenWithFakeRun();
  const std::string first = Create();
  const std::string second = Create();
  run_.AwaitStarted(1);
  LogReader reader;
  const auto watched = Watch(first, reader, 3);
  std::vector<LogRecord> records;
  while (watched.value().cursor->position() < 3) watched.value().cursor->Read(1, &records);
  std::promise<void> release;
  store_->Flush([released = release.get_future().share()] { released.wait(); });
  run_.Allow(2);
  run_.AwaitStarted(2);
  EXPECT_EQ(watched.value().cursor->Read(1, &records), LogCursor::Next::kWait) << "told too early";
  release.set_value();
  EXPECT_EQ(Ended(first).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(second).state(), v1::Job::SUCCEEDED);
}

TEST_F(JobsTest, StopWaitsForTheEndsThatAreBeingStored) {
  std::promise<void> started, go;
  JobOptions options;
  options.run = [&](const Scenario&, Observer&, const std::stop_token&) {
    started.set_value();
    go.get_future().wait();  // Does not look at the stop token.
    return Outcome{};
  };
  Open(options);
  const std::string name = Create();
  started.get_future().wait();
  std::promise<void> release;
  store_->Flush([released = release.get_future().share()] { released.wait(); });
  go.set_value();
  std::jthread stopping([this] { manager_->Stop(); });
  release.set_value();
  stopping.join();
  Await<absl::StatusOr<StoredJob>> stored;
  store_->Read(name, JobPart::kHeader, stored.callback());
  EXPECT_EQ(stored.Get()->job.state(), v1::Job::SUCCEEDED);
}

TEST_F(JobsTest, ThrowingRunFailsItsJobOnly) {
  FakeRun run([](const Scenario& scenario, Observer&, const std::stop_token&) -> Outcome {
    if (scenario.end_time == 13) throw std::runtime_error("it broke");
    return {};
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  run.Allow(3);
  const std::string before = Create();
  const std::string bad = Create(BouncingBall(13));
  const std::string after = Create();
  EXPECT_EQ(Ended(before).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Ended(after).state(), v1::Job::SUCCEEDED);
  const v1::Job job = Ended(bad);
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.state_reason(), "INTERNAL");
  EXPECT_THAT(job.error().message(), HasSubstr("it broke"));
  EXPECT_EQ(job.attempt(), 1) << "it is not tried again";
}

TEST_F(JobsTest, FailedRunKeepsItsReasonAndWarnings) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnWarning("careful");
    return Ending(Outcome::End::kNumeric, "at t = 1 s");
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  run.Allow();
  const v1::Job job = Ended(Create());
  EXPECT_EQ(job.state_reason(), "NUMERIC");
  EXPECT_EQ(job.error().message(), "at t = 1 s");
  EXPECT_THAT(job.warnings(), ElementsAre("careful", HasSubstr("output.sample_interval_s: gives")));
  const auto log = Log(job.name(), 0, {"log_entry"});
  EXPECT_EQ(log[2].log_entry().message(), "careful");
  EXPECT_EQ(log[2].log_entry().severity(), v1::LogEntry::WARNING);
}

TEST_F(JobsTest, FinishedRunTellsOfWhatItsAuthorMayNotWant) {
  Open();
  v1::Scenario scenario = BouncingBall(0.1);  // It would reach the floor after 0.14 s.
  v1::Body& other = *scenario.add_bodies();
  other = scenario.bodies(0);
  other.set_name("other");
  other.set_position_m(0.11);
  other.set_velocity_m_per_s(-3);
  EXPECT_THAT(Ended(Create(scenario)).warnings(),
              ElementsAre(HasSubstr("contacts: were not touched in 0.1 s"),
                          HasSubstr("contacts: have none between ball and other, which passed")));
}

TEST_F(JobsTest, WhatNeedsMoreMemoryThanARunGetsIsRefusedWithBothFigures) {
  Open({.max_budget = {.memory_bytes = 1'000'000}});
  EXPECT_TRUE(Create(RequestFor(BouncingBall(1))).ok());
  v1::Scenario row;
  for (int i = 0; i < 1000; ++i) {
    v1::Body& body = *row.add_bodies();
    body.set_name(fmt::format("B{}", i));
    body.set_mass_kg(1);
    body.set_position_m(i);
  }
  row.set_end_time_s(1);
  const auto refused = Create(RequestFor(row));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "SCENARIO_INVALID");
  EXPECT_THAT(refused.error().message,
              testing::MatchesRegex("scenario: would take about [0-9]+ MB "
                                    "of memory; must take at most 1 MB.*"));
}

TEST_F(JobsTest, WatcherLimitCountsTheLiving) {
  Open(WithFakeRun({.max_watchers = 2}));
  const std::string name = Create();
  LogReader reader;
  auto first = Watch(name, reader);
  const auto second = Watch(name, reader);
  const auto third = Watch(name, reader);
  ASSERT_FALSE(third.ok());
  EXPECT_EQ(third.error().reason, "WATCHER_LIMIT");
  EXPECT_GT(third.error().retry_after.count(), 0);
  first.value().cursor.reset();
  EXPECT_TRUE(Watch(name, reader).ok());
}

TEST_F(JobsTest, WatchOfNoKindIsRefused) {
  OpenWithFakeRun();
  LogReader reader;
  EXPECT_EQ(Watch(Create(), reader, 0, {"cycles"}).error().reason, "FIELD_INVALID");
}

TEST_F(JobsTest, DrainingManagerTakesNoJobs) {
  OpenWithFakeRun();
  const std::string name = Create();
  manager_->creator().Drain();
  EXPECT_EQ(Create(RequestFor(BouncingBall())).error().reason, "SERVER_DRAINING");
  EXPECT_TRUE(Get(name).ok());
  manager_->Stop();
  manager_->Stop();
  EXPECT_EQ(Create(RequestFor(BouncingBall())).error().reason, "SERVER_DRAINING");
}

TEST_F(JobsTest, EveryCallbackHasRunWhenStopReturns) {
  Open(WithFakeRun({.workers = 2}));
  std::atomic<int> answered = 0;
  v1::CancelJobRequest cancel;
  cancel.set_name(Create());
  for (int i = 0; i < 100; ++i) {
    manager_->creator().Create(LocalPrincipal(), RequestFor(BouncingBall()),
                               [&](const auto&) { ++answered; });
    manager_->reader().Get(LocalPrincipal(), cancel.name(), [&](const auto&) { ++answered; });
    manager_->Cancel(LocalPrincipal(), cancel, [&](const auto&) { ++answered; });
  }
  manager_->Stop();
  EXPECT_EQ(answered, 300);
}

}  // namespace
}  // namespace contact
