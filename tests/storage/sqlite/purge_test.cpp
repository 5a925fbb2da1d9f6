#include "storage/sqlite/purge.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "storage/sqlite/database.h"
#include "storage/sqlite/job_changes.h"
#include "storage/store_fixture.h"

namespace contact {
namespace {

class PurgeTest : public testing::Test {
 protected:
  PurgeTest() {
    auto opened = Database::Open(*DataDirectory::Open(folder_.path() / "data"), 0);
    if (!opened.ok()) throw std::runtime_error(opened.status().ToString());
    database_ = *std::move(opened);
    database_->connection().exec("PRAGMA synchronous=OFF");
  }

  // Stores an ended job with these events.
  void Add(const std::string& name, const std::vector<v1::Event>& events) {
    SQLite::Transaction transaction(database_->connection());
    JobInsert insert;
    insert.name = name;
    insert.whose = {"local", "local"};  // As the header says.
    insert.state = v1::Job::SUCCEEDED;
    insert.parts = Split(MakeJob(name));
    insert.events = ToRows(events);
    const auto stored = Insert(*database_, insert);
    ASSERT_TRUE(stored.ok()) << stored.status();
    transaction.commit();
  }

  // As many frame chunks, with another event after each.
  static std::vector<v1::Event> Frames(int chunks) {
    std::vector<v1::Event> events;
    for (int i = 0; i < chunks; ++i) {
      events.push_back(FrameEvent(64 * i));
      events.push_back(LogEvent("between"));
    }
    return events;
  }

  std::int64_t Number(const std::string& sql) {
    return database_->connection().execAndGet(sql).getInt64();
  }
  std::int64_t Events() { return Number("SELECT COUNT(*) FROM events"); }

  TempDirectory folder_;
  std::unique_ptr<Database> database_;
};

TEST_F(PurgeTest, FindsNothingInANewStore) {
  EXPECT_FALSE(Purge(*database_));
  Add("jobs/a", Frames(3));
  EXPECT_FALSE(Purge(*database_));
  EXPECT_EQ(Events(), 6);
}

TEST_F(PurgeTest, RemovedLogGoesInBoundedStepsAndNoOther) {
  Add("jobs/kept", Frames(20));
  for (const int chunks : {0, 1, 15, 16, 17, 50}) {
    Add("jobs/a", Frames(chunks));
    ASSERT_TRUE(Remove(*database_, "jobs/a", "").ok());
    EXPECT_EQ(Events(), 40 + 2 * chunks) << "only out of sight";
    for (std::int64_t before = Events(); Purge(*database_); before = Events()) {
      EXPECT_LE(before - Events(), 32);
    }
    EXPECT_EQ(Events(), 40) << chunks;
    EXPECT_EQ(Number("SELECT COUNT(*) FROM removed"), 0) << chunks;
  }
}

TEST_F(PurgeTest, CompactedLogKeepsAllOtherEventsAndItsSizeIsRightAtEveryStep) {
  for (const int chunks : {0, 1, 31, 32, 33, 64, 100}) {
    Add("jobs/a", Frames(chunks));
    ASSERT_TRUE(Compact(*database_, "jobs/a").ok());
    std::int64_t before = Events();
    do {
      EXPECT_LE(before - Events(), 32);
      before = Events();
      EXPECT_EQ(Number("SELECT bytes FROM jobs"),
                Number("SELECT LENGTH(spec) FROM specs") +
                    Number("SELECT TOTAL(LENGTH(payload)) FROM events"));
    } while (Purge(*database_));
    EXPECT_EQ(Events(), chunks);
    EXPECT_EQ(Number("SELECT COUNT(*) FROM compacting"), 0) << chunks;
    ASSERT_TRUE(Remove(*database_, "jobs/a", "").ok());
    while (Purge(*database_)) {
    }
  }
}

TEST_F(PurgeTest, StepLooksAtABoundedPartOfALongLog) {
  std::vector<v1::Event> events(5000, LogEvent("x"));
  events.push_back(FrameEvent());
  Add("jobs/a", events);
  ASSERT_TRUE(Compact(*database_, "jobs/a").ok());
  ASSERT_TRUE(Purge(*database_));
  EXPECT_EQ(Events(), 5001) << "the chunk is beyond the first 4096 events";
  ASSERT_TRUE(Purge(*database_));
  EXPECT_EQ(Events(), 5000);
  EXPECT_FALSE(Purge(*database_));
}

}  // namespace
}  // namespace contact
