#include "jobs/log_writer.h"

#include "jobs_fixture.h"

namespace contact {
namespace {

class LogWriterTest : public testing::Test {
 protected:
  void Open(std::int64_t max_bytes = 0) {
    store_ = *Store::Open(directory_.path(), {.max_bytes = max_bytes});
    Make("jobs/old", v1::Job::SUCCEEDED);
    Make("jobs/a", v1::Job::QUEUED);
  }
  void Make(const std::string& name, v1::Job::State state) {
    v1::Job job;
    job.set_name(name);
    job.set_state(state);
    const std::vector<v1::Event> events(1);
    Await<absl::StatusOr<StoredJob>> created;
    store_->Create({job, "", events}, created.callback());
    ASSERT_TRUE(created.Get().ok());
  }
  std::unique_ptr<LogWriter> Writer() {
    auto writer = std::make_unique<LogWriter>(*store_, LogWriter::Place{"jobs/a", 0, log_}, run_,
                                              shutdown_.get_token());
    writer->Take(Job(v1::Job::RUNNING), {v1::Event()});
    return writer;
  }
  static v1::Job Job(v1::Job::State state) {
    v1::Job job;
    job.set_name("jobs/a");
    job.set_state(state);
    return job;
  }
  static v1::Event Big() {
    v1::Event event;
    event.mutable_log_entry()->set_message(std::string(100'000, 'x'));
    return event;
  }
  absl::StatusOr<std::uint64_t> Append(const std::string& name,
                                       const std::vector<v1::Event>& events) {
    Await<absl::StatusOr<std::uint64_t>> appended;
    store_->Update({.name = name, .epoch = 0, .events = events}, appended.callback());
    return appended.Get();
  }
  absl::StatusOr<StoredJob> Stored() {
    Await<absl::StatusOr<StoredJob>> job;
    store_->Read("jobs/a", JobPart::kAll, job.callback());
    return job.Get();
  }

  TempDirectory directory_;
  std::unique_ptr<Store> store_;
  std::shared_ptr<JobLog> log_ = std::make_shared<JobLog>(1, false);
  RunControl run_;
  std::stop_source shutdown_;
};

TEST_F(LogWriterTest, EverythingIsStoredWhenFinishReturns) {
  Open();
  const auto writer = Writer();
  for (int i = 0; i < 100; ++i) writer->Add(Big());
  bool committed = false;
  ASSERT_TRUE(writer->Finish(Job(v1::Job::SUCCEEDED), v1::Event(), [&] { committed = true; }));
  EXPECT_TRUE(committed);
  EXPECT_EQ(Stored()->job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Stored()->job.last_sequence(), 103U);
  EXPECT_EQ(Stored()->epoch, 1U);
}

TEST_F(LogWriterTest, WaitsForSpaceAndLosesNothing) {
  Open(3'000'000);
  const auto writer = Writer();
  while (Append("jobs/old", {Big()}).ok()) {
  }
  for (int i = 0; i < 20; ++i) writer->Add(Big());
  ASSERT_EQ(Stored()->job.last_sequence(), 2U) << "it is stuck";
  Await<absl::StatusOr<bool>> deleted;
  store_->Delete("jobs/old", deleted.callback());
  ASSERT_TRUE(deleted.Get().ok());
  EXPECT_TRUE(writer->Finish(Job(v1::Job::SUCCEEDED), v1::Event(), {}));
  EXPECT_EQ(Stored()->job.last_sequence(), 23U);
  EXPECT_FALSE(run_.stopping());
}

TEST_F(LogWriterTest, TakesTheJobOnceThereIsSpace) {
  Open(3'000'000);
  v1::Event small;
  for (const v1::Event& event : {Big(), small}) {
    while (Append("jobs/old", {event}).ok()) {
    }
  }
  const auto writer = Writer();
  ASSERT_EQ(Stored()->job.state(), v1::Job::QUEUED) << "it is stuck";
  Await<absl::StatusOr<bool>> deleted;
  store_->Delete("jobs/old", deleted.callback());
  ASSERT_TRUE(deleted.Get().ok());
  EXPECT_TRUE(writer->Finish(Job(v1::Job::SUCCEEDED), v1::Event(), {}));
  EXPECT_EQ(Stored()->epoch, 1U);
  EXPECT_EQ(Stored()->job.last_sequence(), 3U);
}

TEST_F(LogWriterTest, ShutdownEndsTheWaitForSpace) {
  Open(1'000'000);
  const auto writer = Writer();
  shutdown_.request_stop();
  for (int i = 0; i < 100; ++i) writer->Add(Big());
  EXPECT_FALSE(writer->Finish(Job(v1::Job::SUCCEEDED), v1::Event(), {}));
  EXPECT_EQ(Stored()->job.state(), v1::Job::RUNNING);
}

TEST_F(LogWriterTest, RunOfAJobThatAnotherTookIsStopped) {
  Open();
  const auto writer = Writer();
  const auto other = Writer();  // With the same, now stale epoch.
  other->Add(Big());
  EXPECT_FALSE(other->Finish(Job(v1::Job::FAILED), v1::Event(), {}));
  EXPECT_TRUE(run_.stopping());
  EXPECT_EQ(Stored()->job.state(), v1::Job::RUNNING);
}

}  // namespace
}  // namespace contact
