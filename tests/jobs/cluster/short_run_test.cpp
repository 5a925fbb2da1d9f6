// What a run costs that is shorter than a turn of the database.
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/run/log_writer.h"
#include "storage/postgres/postgres_store.h"
#include "testing/await.h"
#include "testing/fake_sources.h"
#include "testing/postgres_database.h"

namespace contact {
namespace {

class ShortRunTest : public testing::Test {
 protected:
  ShortRunTest() {
    const v1::Job job = Job(v1::Job::QUEUED);
    const std::vector<v1::Event> events(1);
    Await<absl::StatusOr<StoredJob>> created;
    store_->Create({job, "", events}, created.callback());
    EXPECT_TRUE(created.Get().ok());
  }

  static v1::Job Job(v1::Job::State state) {
    v1::Job job;
    job.set_name("jobs/a");
    job.set_state(state);
    return job;
  }
  void Take() { writer_->Take(Job(v1::Job::RUNNING), std::vector<v1::Event>(2)); }
  // Ends the run; true once that is stored.
  std::future<bool> Finish() {
    const auto ended = std::make_shared<std::promise<bool>>();
    writer_->Add({});
    EXPECT_TRUE(writer_->Finish(Job(v1::Job::SUCCEEDED), v1::Event(),
                                [ended](const v1::Job* job) { ended->set_value(job != nullptr); }));
    return ended->get_future();
  }
  void Flush() {
    Await<bool> flushed;
    store_->Flush([done = flushed.callback()] { done(true); });
    flushed.Get();
  }
  // The first event of the newest change.
  std::int64_t FirstOfChange() {
    return database_.Run("SELECT first_of_change FROM contactd.jobs").Integer(0, 0);
  }
  void ExpectWhole() {
    const auto row = database_.Run(
        "SELECT epoch, state, last_sequence, (SELECT count(*) FROM contactd.events)"
        " FROM contactd.jobs");
    EXPECT_EQ(row.Integer(0, 0), 1);
    EXPECT_EQ(row.Integer(0, 1), v1::Job::SUCCEEDED);
    EXPECT_EQ(row.Integer(0, 2), 5);
    EXPECT_EQ(row.Integer(0, 3), 5);
  }

  PostgresDatabase database_;
  std::unique_ptr<Store> store_ = OpenPostgres(database_.address()).value();
  FakeClock clock_;
  std::shared_ptr<JobLog> log_ = std::make_shared<JobLog>(1, false);
  std::stop_source shutdown_;
  std::shared_ptr<LogWriter> writer_ =
      std::make_shared<LogWriter>(*store_, clock_, LogWriter::Place{"jobs/a", 0, log_},
                                  std::make_shared<RunControl>(), shutdown_.get_token());
};

TEST_F(ShortRunTest, IsOneChangeIfItEndsBeforeItsBeginningIsSent) {
  std::promise<std::future<bool>> finished;
  store_->Flush([&] {  // The store's thread is here, so it sends nothing.
    Take();
    finished.set_value(Finish());
  });
  EXPECT_TRUE(finished.get_future().get().get());
  EXPECT_EQ(FirstOfChange(), 2);
  ExpectWhole();
}

TEST_F(ShortRunTest, IsTwoChangesIfItsBeginningWasSent) {
  Take();
  Flush();
  EXPECT_TRUE(Finish().get());
  EXPECT_GT(FirstOfChange(), 3);
  ExpectWhole();
}

}  // namespace
}  // namespace contact
