// What a run hands out early, for those who watch it.
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "jobs/log/job_log.h"
#include "jobs/run/assignment.h"
#include "jobs/run/log_writer.h"
#include "jobs/run/run_recorder.h"
#include "jobs_fixture.h"
#include "simulation/model/derived.h"

namespace contact {
namespace {

using std::chrono::milliseconds;

// The recorder of a run of one ball that takes steps where the test wants them.
class LiveTest : public testing::Test {
 protected:
  explicit LiveTest(milliseconds tick = {}) : clock_(tick) {
    store_ = *OpenSqlite(directory_.path());
    job_.set_name("jobs/a");
    const std::vector<v1::Event> events = {v1::Event()};
    Await<absl::StatusOr<StoredJob>> created;
    store_->Create({job_, "", events}, created.callback());
    EXPECT_TRUE(created.Get().ok());
    writer_ = std::make_shared<LogWriter>(*store_, clock_, LogWriter::Place{"jobs/a", 0, log_},
                                          control_, shutdown_.get_token());
    writer_->Take(job_, {v1::Event()});
    assignment_.log = log_;
    assignment_.record = std::make_shared<RunRecord>();
    assignment_.control = control_;
    scenario_.bodies.resize(1);
    recorder_ =
        std::make_unique<RunRecorder>(scenario_, clock_, assignment_, *writer_, milliseconds(0));
    recorder_->OnSampling([this] { ++asked_; });
  }
  ~LiveTest() override {
    Await<bool> ended;
    writer_->Finish(job_, v1::Event(),
                    [told = ended.callback()](const v1::Job* job) { told(job != nullptr); });
    EXPECT_TRUE(ended.Get());
  }

  // How often the rows that wait were asked for in so many steps.
  int AskedIn(int steps) {
    asked_ = 0;
    for (int i = 0; i < steps; ++i) recorder_->OnStep();
    return asked_;
  }
  std::uint64_t stored() {
    std::uint64_t progress = 0;
    return log_->After({1, ~0U, 1 << 20}, &progress, std::make_shared<const Wake>([] {})).position;
  }
  // Bytes that count against the budget for the samples of one chunk, in parts of so many rows.
  std::int64_t OutputInPartsOf(int rows) {
    const std::int64_t before = control_->signs();
    const int columns = SampleColumns(scenario_);
    for (int first = 0; first < kSamplesPerChunk; first += rows) {
      recorder_->OnSamples({first, columns, std::vector<double>(std::size_t(rows * columns), 1.0)});
    }
    return control_->signs() - before;
  }

  TempDirectory directory_;
  FakeClock clock_;
  std::unique_ptr<Store> store_;
  v1::Job job_;
  const std::shared_ptr<JobLog> log_ = std::make_shared<JobLog>(1, false);
  const std::shared_ptr<RunControl> control_ = std::make_shared<RunControl>();
  std::stop_source shutdown_;
  std::shared_ptr<LogWriter> writer_;
  Assignment assignment_;
  Scenario scenario_;
  std::unique_ptr<RunRecorder> recorder_;
  int asked_ = 0;
};

TEST_F(LiveTest, RowsAreAskedForFiveTimesASecondWhileSomebodyWatches) {
  log_->Join();
  EXPECT_EQ(AskedIn(100), 0);
  clock_.Advance(milliseconds(199));
  EXPECT_EQ(AskedIn(100), 0);
  clock_.Advance(milliseconds(1));
  EXPECT_EQ(AskedIn(16), 1);
  EXPECT_EQ(AskedIn(1000), 0);
  clock_.Advance(milliseconds(10'000));
  EXPECT_EQ(AskedIn(1000), 1) << "what was missed is not made up for";
}

TEST_F(LiveTest, RowsWaitForAWholeChunkWhileNobodyWatches) {
  clock_.Advance(milliseconds(10'000));
  EXPECT_EQ(AskedIn(1000), 0);
  log_->Join();
  EXPECT_EQ(AskedIn(16), 1) << "who comes later sees at once what there is";
  log_->Leave();
  clock_.Advance(milliseconds(10'000));
  EXPECT_EQ(AskedIn(1000), 0);
}

TEST_F(LiveTest, ARunThatWaitsForItsTurnShowsWhatItHas) {
  control_->AskToYield();
  EXPECT_EQ(AskedIn(1), 0);
  log_->Join();
  EXPECT_EQ(AskedIn(1), 1);
}

TEST_F(LiveTest, WhatCameTooSoonAfterTheLastWriteIsWrittenWithoutAnotherEvent) {
  while (stored() < 2) std::this_thread::yield();  // That the job is taken.
  recorder_->OnWarning("another");
  log_->Join();
  AskedIn(16);
  EXPECT_GT(writer_->pending_bytes(), 0u);
  clock_.Advance(milliseconds(20));
  // What was seen to be stored may be on its way still.
  for (int i = 0; i < 100'000 && writer_->pending_bytes() > 0; ++i) {
    AskedIn(16);
    std::this_thread::yield();
  }
  EXPECT_EQ(writer_->pending_bytes(), 0u);
}

TEST_F(LiveTest, ABudgetOfOutputDoesNotDependOnWatchers) {
  const std::int64_t whole = OutputInPartsOf(kSamplesPerChunk);
  for (const int rows : {1, 16, 128}) {
    EXPECT_NEAR(double(OutputInPartsOf(rows)) / double(whole), 1, 0.01) << rows;
  }
}

class LiveCostTest : public LiveTest {
 protected:
  LiveCostTest() : LiveTest(milliseconds(1)) {}
  // Readings of the clock in so many steps.
  std::int64_t ReadingsIn(int steps) {
    const auto before = clock_.Elapsed();
    AskedIn(steps);
    return (clock_.Elapsed() - before) / milliseconds(1) - 1;
  }
};

TEST_F(LiveCostTest, TheClockIsNotReadInEveryStepAndNotAtAllWhileNobodyWatches) {
  EXPECT_EQ(ReadingsIn(16'000), 0);
  log_->Join();
  EXPECT_EQ(ReadingsIn(16'000), 1000);
}

}  // namespace
}  // namespace contact
