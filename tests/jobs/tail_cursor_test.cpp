#include "jobs/log/tail_cursor.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <atomic>
#include <list>
#include <memory>
#include <random>
#include <thread>

#include "jobs/job/lifecycle.h"
#include "jobs/run/log_writer.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;

v1::Event Remark(const std::string& message) {
  v1::Event event;
  event.mutable_log_entry()->set_message(message);
  return event;
}

v1::Event CycleEvent(int number) {
  v1::Event event;
  event.mutable_cycle()->set_number(number);
  return event;
}

v1::Event Changed(v1::Job::State state) {
  v1::Event event;
  event.mutable_state_changed()->set_state(state);
  return event;
}

/// A job in a store, and its log in memory, written as a worker would.
class TailCursorTest : public testing::Test {
 protected:
  void SetUp() override {
    store_ = *OpenSqlite(directory_.path());
    job_.set_name(name_);
    job_.set_state(v1::Job::QUEUED);
    const std::vector<v1::Event> events = {Changed(v1::Job::QUEUED)};
    Await<absl::StatusOr<StoredJob>> created;
    store_->Create({job_, "", events}, created.callback());
    ASSERT_TRUE(created.Get().ok());
    log_ = std::make_shared<JobLog>(1, false);
    writer_ = std::make_shared<LogWriter>(*store_, SystemClock(), LogWriter::Place{name_, 0, log_},
                                          run_, std::stop_token());
    writer_->Take(job_, {Changed(v1::Job::RUNNING)});
  }

  void Finish() {
    job_.set_state(v1::Job::SUCCEEDED);
    Await<bool> ended;
    writer_->Finish(job_, Changed(v1::Job::SUCCEEDED),
                    [told = ended.callback()](const v1::Job* job) { told(job != nullptr); });
    ASSERT_TRUE(ended.Get());
  }

  std::unique_ptr<TailCursor> Cursor(LogReader& reader, std::uint64_t after = 0,
                                     std::uint32_t kinds = ~0U) {
    return std::make_unique<TailCursor>(EventSource{*store_, decoder_, ahead_}, name_, log_, after,
                                        kinds, reader.wake(), watchers_.Take());
  }

  const std::string name_ = "jobs/a";
  TempDirectory directory_;
  Executor decoder_;
  const Places ahead_{16};
  std::unique_ptr<Store> store_;
  v1::Job job_;
  std::shared_ptr<JobLog> log_;
  std::shared_ptr<RunControl> run_ = std::make_shared<RunControl>();
  std::shared_ptr<LogWriter> writer_;
  const Places watchers_{20};
};

// Number of places that nobody has.
int Free(const Places& places) {
  std::vector<Places::Place> taken;
  for (auto place = places.Take(); place; place = places.Take()) taken.push_back(place);
  return static_cast<int>(taken.size());
}

std::vector<std::uint64_t> Sequences(const std::vector<v1::Event>& events) {
  std::vector<std::uint64_t> sequences;
  sequences.reserve(events.size());
  for (const v1::Event& event : events) sequences.push_back(event.sequence());
  return sequences;
}

// The log has more than the memory holds, and readers of every speed, filter and start see the
// same one while it is written.
TEST_F(TailCursorTest, EveryReaderSeesTheLogWithoutGapOrRepeat) {
  constexpr int kEvents = 20'000;
  constexpr std::uint32_t kAll = ~0U;
  const std::uint32_t kCycles = KindBit(v1::Event::kCycle) | KindBit(v1::Event::kStateChanged);
  struct Watch {
    std::uint64_t after;
    std::uint32_t kinds;
    std::size_t max_bytes;
    std::vector<v1::Event> seen = {};
    LogCursor::Next end = LogCursor::Next::kWait;
  };
  std::vector<Watch> watches = {{0, kAll, 1 << 16},    {0, kCycles, 1 << 16}, {7000, kAll, 100},
                                {0, kCycles, 1 << 10}, {0, kAll, 1 << 20},    {19'999, kAll, 1}};
  std::vector<std::thread> readers;
  readers.reserve(watches.size());
  for (Watch& watch : watches) {
    readers.emplace_back([&] {
      LogReader reader;
      const auto cursor = Cursor(reader, watch.after, watch.kinds);
      watch.seen = reader.ToEnd(*cursor, watch.max_bytes);
      watch.end = reader.end();
    });
  }
  std::mt19937 random(1);
  for (int i = 0; i < kEvents; ++i) {
    writer_->Add(random() % 8 == 0 ? CycleEvent(i) : Remark(std::string(random() % 300, 'x')));
  }
  Finish();
  for (std::thread& reader : readers) reader.join();

  LogReader reader;
  const auto replay = reader.ToEnd(*Cursor(reader));
  ASSERT_EQ(replay.size(), kEvents + 3U);
  for (std::size_t i = 0; i < replay.size(); ++i) ASSERT_EQ(replay[i].sequence(), i + 1);
  for (const Watch& watch : watches) {
    std::vector<std::string> expected, seen;
    for (const v1::Event& event : replay) {
      if (event.sequence() > watch.after && (watch.kinds & KindBit(event.payload_case()))) {
        expected.push_back(event.SerializeAsString());
      }
    }
    for (const v1::Event& event : watch.seen) seen.push_back(event.SerializeAsString());
    EXPECT_TRUE(seen == expected) << "after " << watch.after << " in " << watch.max_bytes;
    EXPECT_EQ(watch.end, LogCursor::Next::kEnd);
  }
}

TEST_F(TailCursorTest, OnlyAFewReadAheadAndAllSeeTheWholeLog) {
  for (int i = 0; i < 400; ++i) writer_->Add(Remark(std::string(10'000, 'x')));
  Finish();
  log_ = std::make_shared<JobLog>(403, true);  // Nothing in memory, as after a restart.
  std::list<LogReader> readers(20);
  std::vector<std::unique_ptr<TailCursor>> cursors;
  std::vector<std::vector<std::uint64_t>> seen;
  for (LogReader& reader : readers) {
    cursors.push_back(Cursor(reader));
    seen.push_back(Sequences(reader.Next(*cursors.back())));
  }
  EXPECT_FALSE(ahead_.Take());
  auto reader = readers.begin();
  for (std::size_t i = 0; i < cursors.size(); ++i, ++reader) {
    const auto rest = Sequences(reader->ToEnd(*cursors[i]));
    seen[i].insert(seen[i].end(), rest.begin(), rest.end());
    ASSERT_EQ(seen[i].size(), 403U);
    for (std::size_t j = 0; j < 403; ++j) ASSERT_EQ(seen[i][j], j + 1);
  }
  EXPECT_EQ(Free(ahead_), 16);
}

TEST_F(TailCursorTest, PositionPassesOverWhatWasFilteredOut) {
  LogReader reader;
  const auto cursor = Cursor(reader, 0, KindBit(v1::Event::kStateChanged));
  for (int i = 0; i < 5; ++i) writer_->Add(Remark("x"));
  Finish();
  EXPECT_THAT(Sequences(reader.ToEnd(*cursor)), ElementsAre(1, 2, 8));
  EXPECT_EQ(cursor->position(), 8U);
}

TEST_F(TailCursorTest, ReaderFromTheFutureGetsNothingOld) {
  LogReader reader;
  const auto cursor = Cursor(reader, 5);
  for (int i = 0; i < 5; ++i) writer_->Add(Remark("x"));
  Finish();
  EXPECT_THAT(Sequences(reader.ToEnd(*cursor)), ElementsAre(6, 7, 8));
  for (const std::uint64_t after : {std::uint64_t{100}, UINT64_MAX}) {
    const auto far = Cursor(reader, after);
    EXPECT_TRUE(reader.ToEnd(*far).empty());
    EXPECT_EQ(reader.end(), LogCursor::Next::kEnd);
  }
}

TEST_F(TailCursorTest, ProgressIsTheNewestOnlyAndHasNoSequence) {
  LogReader reader;
  const auto cursor = Cursor(reader, 1);
  ASSERT_THAT(Sequences(reader.Next(*cursor)), ElementsAre(2));
  for (int steps = 1; steps <= 3; ++steps) {
    v1::Event progress;
    progress.mutable_progress()->set_steps(steps);
    log_->SetProgress(progress);
  }
  const auto events = reader.Next(*cursor);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].sequence(), 0U);
  EXPECT_EQ(events[0].progress().steps(), 3);
  std::vector<LogRecord> none;
  EXPECT_EQ(cursor->Read(1, &none), LogCursor::Next::kWait) << "it was seen";
}

TEST_F(TailCursorTest, NoProgressFollowsTheEndOfAJobThatRanElsewhere) {
  Finish();
  log_ = std::make_shared<JobLog>(2, false);  // It has not been told of the end.
  LogReader reader;
  const auto cursor = Cursor(reader);
  ASSERT_THAT(Sequences(reader.Next(*cursor)), ElementsAre(1, 2, 3));
  log_->SetProgress({});
  std::vector<LogRecord> none;
  EXPECT_EQ(cursor->Read(1, &none), LogCursor::Next::kWait);
  log_->Advance(3, true);
  EXPECT_EQ(cursor->Read(1, &none), LogCursor::Next::kEnd);
}

TEST_F(TailCursorTest, DeletedJobEndsTheWatch) {
  Finish();
  LogReader reader;
  log_ = std::make_shared<JobLog>(3, true);  // Nothing in memory, as after a restart.
  const auto cursor = Cursor(reader);
  Await<absl::StatusOr<JobOwner>> deleted;
  store_->Delete(name_, "", deleted.callback());
  ASSERT_TRUE(deleted.Get().ok());
  EXPECT_TRUE(reader.ToEnd(*cursor).empty());
  EXPECT_EQ(reader.end(), LogCursor::Next::kDeleted);
}

TEST_F(TailCursorTest, DamagedEventIsReportedInItsPlace) {
  writer_->Add(Remark("good"));
  writer_->Add(Remark("bad"));
  Finish();
  writer_.reset();
  store_.reset();
  SQLite::Database(directory_.path() / "contactd.db", SQLite::OPEN_READWRITE)
      .exec("UPDATE events SET payload=zeroblob(9) WHERE sequence=4");
  store_ = *OpenSqlite(directory_.path());
  log_ = std::make_shared<JobLog>(5, true);
  LogReader reader;
  const auto events = reader.ToEnd(*Cursor(reader));
  EXPECT_THAT(Sequences(events), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(events[2].log_entry().message(), "good");
  EXPECT_THAT(events[3].log_entry().message(), testing::HasSubstr("event 4 is damaged"));
  EXPECT_EQ(reader.end(), LogCursor::Next::kEnd);
}

TEST_F(TailCursorTest, CursorsMayLeaveWhileTheLogIsWritten) {
  std::thread visitor([&] {
    for (int i = 0; i < 500; ++i) {
      LogReader reader;
      const auto cursor = Cursor(reader, static_cast<std::uint64_t>(i % 3) * 1000);
      std::vector<LogRecord> events;
      cursor->Read(1 << 12, &events);
      cursor->Read(1 << 12, &events);
    }
  });
  for (int i = 0; i < 20'000; ++i) writer_->Add(Remark("some text"));
  visitor.join();
  EXPECT_EQ(Free(watchers_), 20);
}

}  // namespace
}  // namespace contact
