#include "rpc/stream/watch_source.h"

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "test_server.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// A cursor that reads what the test has put in, and waits otherwise.
class FakeCursor final : public LogCursor {
 public:
  Next Read(std::size_t bytes, std::vector<LogRecord>* out) override {
    max_bytes = bytes;
    if (end) return *end;
    if (records.empty()) return Next::kWait;
    for (LogRecord& record : records) {
      position_ = std::max(position_, record.sequence);
      out->push_back(std::move(record));
    }
    records.clear();
    return Next::kEvents;
  }
  std::uint64_t position() const override { return position_; }
  std::uint64_t oldest() const override { return 7; }

  std::vector<LogRecord> records;
  std::optional<Next> end;
  std::size_t max_bytes = 0;  // Of the last Read.

 private:
  std::uint64_t position_ = 0;
};

class WatchSourceTest : public testing::Test {
 protected:
  WatchSourceTest() {
    auto cursor = std::make_unique<FakeCursor>();
    cursor_ = cursor.get();
    WatchedJob watched;
    watched.snapshot.set_name("jobs/a");
    watched.cursor = std::move(cursor);
    watched.bookmark_interval = 10s;
    watched.message_bytes = [this] { return message_bytes_; };
    source_ = MakeWatchSource(std::move(watched), clock_, metrics_);
  }

  // The next message; nothing if there is none.
  std::optional<v1::WatchJobResponse> Read() {
    grpc::ByteBuffer bytes;
    StreamStep step = source_->Read(&bytes);
    ended_ = step.ended;
    error_ = std::move(step.error);
    if (!step.has_message) return std::nullopt;
    v1::WatchJobResponse message;
    EXPECT_TRUE(
        grpc::SerializationTraits<v1::WatchJobResponse>::Deserialize(&bytes, &message).ok());
    return message;
  }

  void Log(std::uint64_t sequence) {
    v1::Event event;
    event.mutable_log_entry()->set_message("word");
    cursor_->records.push_back(ToRecord(sequence, std::move(event)));
  }

  FakeClock clock_;
  StreamMetrics metrics_;
  FakeCursor* cursor_ = nullptr;
  std::size_t message_bytes_ = 1000;
  std::unique_ptr<StreamSource<grpc::ByteBuffer>> source_;
  bool ended_ = false;
  std::optional<Error> error_;
};

TEST_F(WatchSourceTest, SnapshotComesFirstAndOnce) {
  Log(1);
  const auto first = Read();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->snapshot().name(), "jobs/a");
  EXPECT_EQ(first->events_size(), 0);
  const auto second = Read();
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->has_snapshot());
  EXPECT_EQ(second->events(0).sequence(), 1U);
  EXPECT_FALSE(Read());
  EXPECT_FALSE(ended_ || error_);
}

TEST_F(WatchSourceTest, EachMessageHasTheSizeOfItsTime) {
  Read();
  for (const std::size_t bytes : {1000U, 16U}) {
    message_bytes_ = bytes;
    Read();
    EXPECT_EQ(cursor_->max_bytes, bytes);
  }
}

TEST_F(WatchSourceTest, BookmarkTellsThePositionOnceAnInterval) {
  Read();
  Log(3);
  Read();
  clock_.Advance(9999ms);
  EXPECT_FALSE(source_->IsDue(clock_.Elapsed()));
  EXPECT_FALSE(Read());
  clock_.Advance(1ms);
  EXPECT_TRUE(source_->IsDue(clock_.Elapsed()));
  const auto message = Read();
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->events(0).has_bookmark());
  EXPECT_EQ(message->events(0).sequence(), 3U);
  EXPECT_FALSE(Read()) << "the next interval has only begun";
}

TEST_F(WatchSourceTest, BookmarkComesWithAnEventOnlyIfThatHasNoSequence) {
  Read();
  for (const std::uint64_t sequence : {1U, 0U}) {
    clock_.Advance(10s);
    Log(sequence);
    const auto message = Read();
    ASSERT_TRUE(message);
    ASSERT_EQ(message->events_size(), sequence > 0 ? 1 : 2);
    EXPECT_NE(message->events(message->events_size() - 1).has_bookmark(), sequence > 0);
    EXPECT_FALSE(source_->IsDue(clock_.Elapsed()));
  }
}

TEST_F(WatchSourceTest, GapsAreCountedByTheEventsTheyStandFor) {
  Read();
  v1::Event event;
  event.mutable_gap()->set_dropped_count(5);
  cursor_->records.push_back(ToRecord(0, event));
  Read();
  EXPECT_EQ(metrics_.conflated, 5);
}

TEST_F(WatchSourceTest, EachEndOfTheCursorIsAStatusOfTheContract) {
  const std::vector<std::pair<LogCursor::Next, std::string>> cases = {
      {LogCursor::Next::kDeleted, "JOB_NOT_FOUND"},
      {LogCursor::Next::kCompacted, "EVENTS_COMPACTED"},
      {LogCursor::Next::kSlow, "SLOW_WATCHER"},
      {LogCursor::Next::kFailed, "STORE_FAILED"},
  };
  Read();
  for (const auto& [next, reason] : cases) {
    cursor_->end = next;
    EXPECT_FALSE(Read());
    ASSERT_TRUE(error_) << reason;
    EXPECT_EQ(error_->reason, reason);
  }
  cursor_->end = LogCursor::Next::kEnd;
  EXPECT_FALSE(Read());
  EXPECT_TRUE(ended_);
  EXPECT_FALSE(error_);
}

}  // namespace
}  // namespace contact
