// What the PostgreSQL engine promises beyond the calls that every engine has.
#include "storage/postgres/postgres_store.h"

#include <absl/strings/str_cat.h>
#include <gmock/gmock.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "storage/every_store.h"
#include "storage/postgres/schema.h"
#include "storage/postgres/statements.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

using testing::HasSubstr;

class PostgresStoreTest : public StoreTest {
 protected:
  absl::StatusOr<std::unique_ptr<Store>> OpenStore(StoreOptions options) override {
    return OpenPostgres(database_.address(), std::move(options));
  }
  ~PostgresStoreTest() override { store_.reset(); }

  // Ends the store's connection, as an administrator can.
  void CutConnections() {
    database_.Run(
        "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity"
        " WHERE datname = current_database() AND pid <> pg_backend_pid()");
  }
  std::int64_t Count(const std::string& table) {
    return database_.Run("SELECT count(*) FROM contactd." + table).Integer(0, 0);
  }

  PostgresDatabase database_;
};

TEST_F(PostgresStoreTest, LostConnectionIsReplacedUnseen) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  for (int i = 0; i < 5; ++i) {
    CutConnections();
    ASSERT_TRUE(Append("jobs/a", {LogEvent("x")}).ok());
  }
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 6U);
  EXPECT_EQ(Count("events"), 6);
}

TEST_F(PostgresStoreTest, ConnectionThatIsCutWhileMuchIsAskedLosesAndRepeatsNothing) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  constexpr int kUpdates = 2000;
  const std::vector<v1::Event> events = {LogEvent("x"), LogEvent("y")};
  std::vector<std::uint64_t> firsts;  // Of the store's thread until flushed.
  const std::string name = "jobs/a";
  for (int i = 0; i < kUpdates; ++i) {
    store_->Update({.name = name, .events = events},
                   [&firsts](const absl::StatusOr<std::uint64_t>& first) {
                     firsts.push_back(first.value_or(0));
                   });
    if (i % 400 == 0) CutConnections();
  }
  Await<bool> flushed;
  store_->Flush([done = flushed.callback()] { done(true); });
  flushed.Get();
  ASSERT_EQ(firsts.size(), static_cast<std::size_t>(kUpdates));
  for (std::size_t i = 0; i < firsts.size(); ++i) EXPECT_EQ(firsts[i], 2 + 2 * i);
  EXPECT_EQ(Count("events"), 1 + 2 * kUpdates);
}

TEST_F(PostgresStoreTest, ChangeIsRecalledBeforeItIsSentAndNotAfter) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::vector<v1::Event> events = {LogEvent("x")};
  const std::string name = "jobs/a";
  const auto change = Store::Encode({.name = name, .events = events});
  const auto other = Store::Encode({.name = name, .events = events});
  bool told = false;
  Await<bool> recalled;
  store_->Flush([&] {  // The store's thread is here, so it sends nothing.
    store_->Update(change, 0, [&told](const auto&) { told = true; });
    store_->Update(other, 0, [](const auto&) {});
    recalled.callback()(store_->Recall(change));
  });
  EXPECT_TRUE(recalled.Get());
  Await<absl::StatusOr<std::uint64_t>> first;
  store_->Update(change, 0, first.callback());
  EXPECT_EQ(first.Get().value(), 3U) << "after the other one";
  EXPECT_FALSE(told);
  EXPECT_FALSE(store_->Recall(change));
}

TEST_F(PostgresStoreTest, TakeSoonAfterAnotherChangeWaitsForTheNextOrAWhile) {
  FakeClock clock;
  Open({.clock = &clock});
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  job.set_state(v1::Job::RUNNING);
  const std::string name = job.name();
  const std::vector<v1::Event> events = {LogEvent("x")};
  const auto take = [&] {
    return Store::Encode({.name = name, .take = true, .job = &job, .events = events});
  };
  Await<absl::StatusOr<std::uint64_t>> at_once;
  store_->Update(take(), 0, at_once.callback());
  EXPECT_EQ(at_once.Get().value(), 2U) << "a job that ends the process has been taken";

  const auto recalled = take();
  store_->Update(recalled, 1, [](const auto&) { ADD_FAILURE(); });
  EXPECT_TRUE(store_->Recall(recalled)) << "nothing else is to be sent";

  Await<absl::StatusOr<std::uint64_t>> after_a_while;
  store_->Update(take(), 1, after_a_while.callback());
  clock.Advance(std::chrono::milliseconds(5));
  EXPECT_EQ(after_a_while.Get().value(), 3U);

  Await<absl::StatusOr<std::uint64_t>> with_the_next;
  store_->Update(take(), 2, with_the_next.callback());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  EXPECT_EQ(with_the_next.Get().value(), 4U);
}

// Two hundred jobs wait of which the planner knows nothing: it saw the table when all had ended.
TEST_F(PostgresStoreTest, ChangeReadsNoOtherJob) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  v1::Job ended = MakeJob("jobs/b");
  ended.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Create(ended).ok());
  database_.Run("UPDATE contactd.jobs SET state = 3");
  database_.Run("ANALYZE");
  database_.Run("UPDATE contactd.jobs SET state = 1 WHERE name = 'jobs/a'");
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(Create(MakeJob("jobs/w" + std::to_string(i))).ok());

  const std::vector<v1::Event> events = {LogEvent("x")};
  const std::string name = "jobs/a";
  const postgres::Statement change =
      postgres::ChangeJob(*Store::Encode({.name = name, .events = events}), 0);
  const postgres::Statement reads{
      "SELECT seq_tup_read + idx_tup_fetch FROM pg_stat_xact_user_tables"
      " WHERE relid = 'contactd.jobs'::regclass"};
  const auto answers =
      postgres::Connection::Open(database_.address()).value()->Run({&change, &reads});
  ASSERT_TRUE(answers.ok()) << answers.status();
  EXPECT_EQ(postgres::Changed(answers->front(), name).value(), 2U);
  EXPECT_LT(answers->back().Integer(0, 0), 5);
}

TEST_F(PostgresStoreTest, ChangeThatIsSentAgainIsDoneOnce) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::vector<v1::Event> events = {LogEvent("2"), LogEvent("3")};
  const std::string name = "jobs/a";
  const auto change = Store::Encode({.name = name, .take = true, .events = events});
  for (int i = 0; i < 3; ++i) {
    Await<absl::StatusOr<std::uint64_t>> first;
    store_->Update(change, 0, first.callback());
    EXPECT_EQ(first.Get().value(), 2U);
  }
  EXPECT_EQ(Read("jobs/a")->epoch, 1U);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 3U);
}

TEST_F(PostgresStoreTest, SessionThatWasReplacedDoesNothingMore) {
  const auto late = postgres::Connection::Open(database_.address()).value();
  const auto next = postgres::Connection::Open(database_.address()).value();
  EXPECT_NE(late->session(), next->session());
  ASSERT_TRUE(next->End(late->session()).ok());
  EXPECT_EQ(late->Run({"SELECT 1"}).status().code(), absl::StatusCode::kUnavailable);
  EXPECT_TRUE(next->End(late->session()).ok()) << "there is none any more";
  EXPECT_TRUE(next->Run({"SELECT 1"}).ok());
}

TEST_F(PostgresStoreTest, JobThatIsSentAgainIsMadeOnce) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a"))->created);
  EXPECT_TRUE(Create(MakeJob("jobs/a"))->created);
  EXPECT_EQ(Count("jobs"), 1);
  EXPECT_EQ(Count("events"), 1);
}

TEST_F(PostgresStoreTest, OperationThatFailsDoesNotHarmThoseBesideIt) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  v1::Job other = MakeJob("jobs/a");
  other.set_uid("other");  // Its name is taken.
  const std::string name = "jobs/a";
  const std::vector<v1::Event> events = {LogEvent("x")};
  int done = 0;  // Of the store's thread until flushed.
  int failed = 0;
  for (int i = 0; i < 50; ++i) {
    store_->Update({.name = name, .events = events},
                   [&done](const auto& first) { done += first.ok(); });
    store_->Create({other, "", events}, [&failed](const auto& made) { failed += !made.ok(); });
  }
  Await<bool> flushed;
  store_->Flush([told = flushed.callback()] { told(true); });
  flushed.Get();
  EXPECT_EQ(done, 50);
  EXPECT_EQ(failed, 50);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 51U);
}

TEST_F(PostgresStoreTest, ProgramThatWantsItAloneIsRefusedWhileOthersUseIt) {
  Open();
  EXPECT_TRUE(OpenStore({}).ok());
  const auto alone = OpenPostgresAlone(database_.address());
  EXPECT_TRUE(absl::IsUnavailable(alone.status()));
  EXPECT_THAT(alone.status().ToString(), HasSubstr("another contactd"));
  store_.reset();
  const auto later = OpenPostgresAlone(database_.address());
  EXPECT_TRUE(later.ok());
  EXPECT_TRUE(absl::IsUnavailable(OpenStore({}).status()));
}

TEST_F(PostgresStoreTest, ProgramsThatBeginAtOnceMakeTheTablesOnce) {
  std::vector<std::thread> programs;
  for (int i = 0; i < 8; ++i) {
    programs.emplace_back(
        [this] { EXPECT_EQ(MigratePostgres(database_.address()), absl::OkStatus()); });
  }
  for (std::thread& program : programs) program.join();
  EXPECT_EQ(Count("version"), 1);
}

TEST_F(PostgresStoreTest, NewerTablesAreRefused) {
  Open();
  store_.reset();
  database_.Run("UPDATE contactd.version SET version = version + 1");
  const auto opened = OpenStore({});
  EXPECT_TRUE(absl::IsFailedPrecondition(opened.status()));
  EXPECT_THAT(opened.status().ToString(), HasSubstr("start the newer program"));
}

TEST_F(PostgresStoreTest, AddressThatNobodyAnswersIsToldAtOnce) {
  const auto opened = OpenPostgres("postgresql://contactd@127.0.0.1:1/none");
  EXPECT_TRUE(absl::IsUnavailable(opened.status())) << opened.status();
  EXPECT_TRUE(absl::IsFailedPrecondition(
      OpenPostgres(database_.address() + "&dbname=none_of_these").status()));
}

TEST_F(PostgresStoreTest, DamageCostsThatObjectOnly) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  ASSERT_TRUE(Append("jobs/a", {LogEvent("2")}).ok());
  database_.Run("UPDATE contactd.events SET payload = payload || '\\x00' WHERE sequence = 2");
  const auto page = ReadEvents({.name = "jobs/a"});
  EXPECT_TRUE(page->events[0].intact);
  EXPECT_FALSE(page->events[1].intact);
  EXPECT_TRUE(Read("jobs/a").ok());
  database_.Run("UPDATE contactd.specs SET spec = spec || '\\x00' WHERE job = 1");
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a").status()));
  EXPECT_TRUE(Read("jobs/a", JobPart::kHeader).ok());
  database_.Run("UPDATE contactd.jobs SET tenant = 'umbra' WHERE number = 1");
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a", JobPart::kHeader).status()));
  EXPECT_TRUE(Read("jobs/b").ok());
}

TEST_F(PostgresStoreTest, WhatBelongsToAnotherJobFailsItsChecksum) {
  Open();
  for (const char* name : {"jobs/a", "jobs/b"}) {
    v1::Job job = MakeJob(name);
    ASSERT_TRUE(Create(job).ok());
    job.set_state(v1::Job::SUCCEEDED);
    job.add_cycles();
    ASSERT_TRUE(Update({.name = name, .job = &job}).ok());
  }
  const auto copy = [this](const std::string& table, const std::string& column) {
    database_.Run(absl::StrCat("UPDATE contactd.", table, " t SET crc32 = o.crc32, ", column,
                               " = o.", column, " FROM contactd.", table,
                               " o WHERE o.job = 2 AND t.job = 1"));
  };
  copy("events", "payload");
  EXPECT_FALSE(ReadEvents({.name = "jobs/a"})->events[0].intact);
  EXPECT_TRUE(Read("jobs/a").ok());
  copy("results", "result");
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a").status()));
  EXPECT_TRUE(Read("jobs/a", JobPart::kSpec).ok());
  copy("specs", "spec");
  EXPECT_TRUE(absl::IsDataLoss(Read("jobs/a", JobPart::kSpec).status()));
  EXPECT_TRUE(Read("jobs/b").ok());
}

TEST_F(PostgresStoreTest, CheckpointOfAnotherJobIsNone) {
  Open();
  for (const std::string name : {"jobs/a", "jobs/b"}) {
    ASSERT_TRUE(Create(MakeJob(name)).ok());
    const Checkpoint checkpoint{0, "state of " + name};
    ASSERT_TRUE(Update({.name = name, .checkpoint = &checkpoint}).ok());
  }
  EXPECT_EQ(Read("jobs/a", JobPart::kRun)->checkpoint, "state of jobs/a");
  database_.Run(
      "UPDATE contactd.checkpoints t SET crc32 = o.crc32, state = o.state"
      " FROM contactd.checkpoints o WHERE o.job = 2 AND t.job = 1");
  EXPECT_EQ(Read("jobs/a", JobPart::kRun)->checkpoint, "");
}

// The server's default must not weaken the promise that what is answered is on disk.
TEST_F(PostgresStoreTest, CommitsAreOnDiskWhateverTheDefaultIs) {
  Open();
  database_.Run("ALTER ROLE contactd SET synchronous_commit = off");
  const auto connection = postgres::Connection::Open(database_.address());
  ASSERT_TRUE(connection.ok()) << connection.status();
  EXPECT_EQ((*connection)->Run({"SHOW synchronous_commit"})->Bytes(0, 0), "on");
  database_.Run("ALTER ROLE contactd RESET synchronous_commit");
}

}  // namespace
}  // namespace contact
