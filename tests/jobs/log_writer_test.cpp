#include "jobs/run/log_writer.h"

#include <string>
#include <thread>

#include "jobs_fixture.h"

namespace contact {
namespace {

class LogWriterTest : public testing::Test {
 protected:
  void Open(std::int64_t max_bytes = 0) {
    store_ = *OpenSqlite(directory_.path(), {.max_bytes = max_bytes});
    ASSERT_TRUE(Make("jobs/first", v1::Job::QUEUED, {}));
    ASSERT_TRUE(Make("jobs/a", v1::Job::QUEUED, {}));
  }
  bool Make(const std::string& name, v1::Job::State state, const v1::Event& event) {
    v1::Job job;
    job.set_name(name);
    job.set_state(state);
    const std::vector<v1::Event> events = {event};
    Await<absl::StatusOr<StoredJob>> created;
    store_->Create({job, "", events}, created.callback());
    return created.Get().ok();
  }
  std::shared_ptr<LogWriter> Writer() {
    auto writer = std::make_shared<LogWriter>(*store_, clock_, LogWriter::Place{"jobs/a", 0, log_},
                                              run_, shutdown_.get_token());
    writer->Take(Job(v1::Job::RUNNING), {v1::Event()});
    return writer;
  }
  // Begins to end the job; `ended` gets whether that was stored.
  static void Finish(LogWriter& writer, v1::Job::State state, Await<bool>& ended) {
    writer.Finish(Job(state), v1::Event(),
                  [told = ended.callback()](const v1::Job* job) { told(job != nullptr); });
  }
  bool Finished(LogWriter& writer, v1::Job::State state) {
    Await<bool> ended;
    Finish(writer, state, ended);
    while (!ended.ready()) {
      clock_.Advance(std::chrono::seconds(1));
      writer.Retry();
      std::this_thread::yield();
    }
    return ended.Get();
  }
  // Fills the store with ended jobs of one event, until not one more fits in.
  void Fill(const v1::Event& event) {
    while (Make(Old(old_), v1::Job::SUCCEEDED, event)) ++old_;
  }
  void FillStore() {
    Fill(Big());
    while (Append("jobs/first", {v1::Event()}).ok()) {
    }
  }
  void MakeSpace() {
    for (; old_ > 0; --old_) {
      Await<absl::StatusOr<JobOwner>> deleted;
      store_->Delete(Old(old_ - 1), "", deleted.callback());
      ASSERT_TRUE(deleted.Get().ok());
    }
  }
  static std::string Old(int number) { return "jobs/old" + std::to_string(number); }
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
    auto stored = job.Get();
    EXPECT_TRUE(!stored.ok() || stored->MergeResult());
    return stored;
  }

  StoredJob ToRun() {
    Await<absl::StatusOr<StoredJob>> job;
    store_->Read("jobs/a", JobPart::kRun, job.callback());
    return *job.Get();
  }
  // Once so many events are stored.
  StoredJob StoredAfter(std::uint64_t sequence, LogWriter& writer) {
    for (;;) {
      StoredJob stored = ToRun();
      if (stored.job.last_sequence() >= sequence) return stored;
      clock_.Advance(std::chrono::seconds(1));
      writer.WriteIfDue();
    }
  }

  int old_ = 0;
  TempDirectory directory_;
  std::unique_ptr<Store> store_;
  FakeClock clock_;
  std::shared_ptr<JobLog> log_ = std::make_shared<JobLog>(1, false);
  std::shared_ptr<RunControl> run_ = std::make_shared<RunControl>();
  std::stop_source shutdown_;
};

TEST_F(LogWriterTest, EverythingIsStoredWhenTheEndIsTold) {
  Open();
  const auto writer = Writer();
  for (int i = 0; i < 100; ++i) writer->Add(Big());
  ASSERT_TRUE(Finished(*writer, v1::Job::SUCCEEDED));
  EXPECT_EQ(Stored()->job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(Stored()->job.last_sequence(), 103U);
  EXPECT_EQ(Stored()->epoch, 1U);
}

TEST_F(LogWriterTest, WaitsForSpaceAndLosesNothing) {
  Open(3'000'000);
  const auto writer = Writer();
  Fill(Big());
  for (int i = 0; i < 20; ++i) writer->Add(Big());
  ASSERT_EQ(Stored()->job.last_sequence(), 2U) << "it is stuck";
  MakeSpace();
  EXPECT_TRUE(Finished(*writer, v1::Job::SUCCEEDED));
  EXPECT_EQ(Stored()->job.last_sequence(), 23U);
  EXPECT_FALSE(run_->stopping());
}

TEST_F(LogWriterTest, TakesTheJobOnceThereIsSpace) {
  Open(3'000'000);
  FillStore();
  const auto writer = Writer();
  ASSERT_EQ(Stored()->job.state(), v1::Job::QUEUED) << "it is stuck";
  MakeSpace();
  EXPECT_TRUE(Finished(*writer, v1::Job::SUCCEEDED));
  EXPECT_EQ(Stored()->epoch, 1U);
  EXPECT_EQ(Stored()->job.last_sequence(), 3U);
}

TEST_F(LogWriterTest, ShutdownEndsTheWaitForSpace) {
  Open(1'000'000);
  const auto writer = Writer();
  shutdown_.request_stop();
  for (int i = 0; i < 100; ++i) writer->Add(Big());
  EXPECT_FALSE(Finished(*writer, v1::Job::SUCCEEDED));
  EXPECT_EQ(Stored()->job.state(), v1::Job::RUNNING);
}

TEST_F(LogWriterTest, NothingIsToldOfTheEndBeforeItIsStored) {
  Open();
  const auto writer = Writer();
  std::promise<void> release;
  store_->Flush([released = release.get_future().share()] { released.wait(); });
  Await<bool> ended;
  Finish(*writer, v1::Job::SUCCEEDED, ended);
  EXPECT_FALSE(ended.ready());
  std::uint64_t seen = 0;
  const auto waker = std::make_shared<const Wake>([] {});
  EXPECT_EQ(log_->After({2, ~0U, 1 << 20}, &seen, waker).found, JobLog::Tail::Found::kNothing);
  EXPECT_TRUE(run_->held()) << "nor is it a stall";
  release.set_value();
  EXPECT_TRUE(ended.Get());
  EXPECT_EQ(Stored()->job.state(), v1::Job::SUCCEEDED);
}

TEST_F(LogWriterTest, EndThatFindsNoSpaceIsStoredLater) {
  Open(3'000'000);
  const auto writer = Writer();
  ASSERT_EQ(Stored()->job.state(), v1::Job::RUNNING);
  FillStore();
  writer->Add(Big());
  Await<bool> ended;
  Finish(*writer, v1::Job::SUCCEEDED, ended);
  ASSERT_EQ(Stored()->job.state(), v1::Job::RUNNING) << "it is stuck";
  EXPECT_FALSE(ended.ready());
  MakeSpace();
  while (!ended.ready()) {
    clock_.Advance(std::chrono::seconds(1));
    writer->Retry();
    std::this_thread::yield();
  }
  EXPECT_TRUE(ended.Get());
  EXPECT_EQ(Stored()->job.last_sequence(), 4U);
}

TEST_F(LogWriterTest, CheckpointStandsAfterTheEventsBeforeIt) {
  Open();
  const auto writer = Writer();
  for (int i = 0; i < 3; ++i) writer->Add(Big());
  writer->AddCheckpoint("here");
  writer->Add(Big());
  writer->WriteIfDue();
  const StoredJob stored = StoredAfter(6, *writer);
  EXPECT_EQ(stored.checkpoint, "here");
  EXPECT_EQ(stored.checkpoint_sequence, 5U);
  ASSERT_TRUE(Finished(*writer, v1::Job::QUEUED));
  EXPECT_EQ(ToRun().checkpoint, "here");
}

TEST_F(LogWriterTest, RunOfAJobThatAnotherTookIsStopped) {
  Open();
  const auto writer = Writer();
  const auto other = Writer();  // With the same, now stale epoch.
  other->Add(Big());
  EXPECT_FALSE(Finished(*other, v1::Job::FAILED));
  EXPECT_TRUE(run_->stopping());
  EXPECT_EQ(Stored()->job.state(), v1::Job::RUNNING);
}

}  // namespace
}  // namespace contact
