#include "jobs/log/delivery_cursor.h"

#include <gmock/gmock.h>

#include <deque>
#include <string>

#include "jobs_fixture.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

LogRecord Record(std::uint64_t sequence, char kind) {
  v1::Event event;
  if (kind == 'f' || kind == 'F') event.mutable_frame_chunk()->set_samples(1);
  if (kind == 'F') event.mutable_frame_chunk()->set_columns_follow(true);
  if (kind == 'c') event.mutable_cycle()->set_number(1);
  if (kind == 'p') event.mutable_progress();
  if (kind == 's') event.mutable_state_changed()->set_state(v1::Job::SUCCEEDED);
  return ToRecord(kind == 'p' ? 0 : sequence, event);
}

/// A log whose every read is a word: a letter for each event, a large F for a chunk whose columns
/// follow. After the last word it waits.
class Script final : public LogCursor {
 public:
  explicit Script(std::deque<std::string> words) : words_(std::move(words)) {}
  Next Read(std::size_t /*max_bytes*/, std::vector<LogRecord>* out) override {
    if (words_.empty()) return Next::kWait;
    for (const char kind : words_.front()) {
      out->push_back(Record(position_ + 1, kind));
      if (kind != 'p') ++position_;
    }
    words_.pop_front();
    return Next::kEvents;
  }
  std::uint64_t position() const override { return position_; }
  std::uint64_t oldest() const override { return 1; }

 private:
  std::deque<std::string> words_;
  std::uint64_t position_ = 0;
};

class DeliveryCursorTest : public testing::Test {
 protected:
  void Open(std::deque<std::string> words, DeliveryCursor::Rules rules) {
    cursor_ = std::make_unique<DeliveryCursor>(
        std::make_unique<Script>(std::move(words)), [this] { return behind_; }, clock_, rules);
  }
  // What one read delivers: `f3`, or `g1-2` for a gap.
  std::vector<std::string> Read() {
    std::vector<LogRecord> records;
    last_ = cursor_->Read(1 << 16, &records);
    std::vector<std::string> words;
    for (const v1::Event& event : ToEvents(records)) {
      if (event.has_gap()) {
        EXPECT_EQ(event.sequence(), event.gap().last_sequence());
        words.push_back("g" + std::to_string(event.gap().first_sequence()) + "-" +
                        std::to_string(event.gap().last_sequence()) + "x" +
                        std::to_string(event.gap().dropped_count()));
      } else {
        const char kind = event.has_frame_chunk() ? 'f' : event.has_cycle() ? 'c' : 's';
        words.push_back((event.has_progress() ? 'p' : kind) + std::to_string(event.sequence()));
      }
    }
    return words;
  }

  bool behind_ = false;
  FakeClock clock_;
  std::unique_ptr<DeliveryCursor> cursor_;
  LogCursor::Next last_ = LogCursor::Next::kWait;
};

TEST_F(DeliveryCursorTest, WithoutWishesAllPasses) {
  Open({"cffc", "fps"}, {});
  EXPECT_THAT(Read(), ElementsAre("c1", "f2", "f3", "c4"));
  EXPECT_THAT(Read(), ElementsAre("f5", "p0", "s6"));
  EXPECT_EQ(cursor_->position(), 6U);
}

TEST_F(DeliveryCursorTest, ColumnsOfAChunkPassOrAreLeftOutTogether) {
  Open({"FFfFF", "fFfc"}, {.min_frame_interval = 1s});
  EXPECT_THAT(Read(), ElementsAre("f1", "f2", "f3"));
  EXPECT_EQ(cursor_->position(), 3U);
  EXPECT_THAT(Read(), ElementsAre("g4-8x5", "c9"));
}

TEST_F(DeliveryCursorTest, ColumnsThatFollowAChunkThatWasHeldBackPass) {
  Open({"f", "F"}, {.min_frame_interval = 1s});
  EXPECT_THAT(Read(), ElementsAre("f1"));
  EXPECT_TRUE(Read().empty());
  clock_.Advance(1s);
  EXPECT_THAT(Read(), ElementsAre("f2"));
  EXPECT_EQ(cursor_->position(), 2U);
}

TEST_F(DeliveryCursorTest, FramesWithinTheIntervalAreLeftOutAndNamed) {
  Open({"cfffc", "ffcf"}, {.min_frame_interval = 1s});
  EXPECT_THAT(Read(), ElementsAre("c1", "f2", "g3-4x2", "c5"));
  EXPECT_THAT(Read(), ElementsAre("g6-7x2", "c8"));
  EXPECT_TRUE(Read().empty());
  EXPECT_EQ(last_, LogCursor::Next::kWait);
}

TEST_F(DeliveryCursorTest, NewestFrameComesWhenItIsTimeThoughNothingElseDoes) {
  Open({"fff"}, {.min_frame_interval = 1s});
  EXPECT_THAT(Read(), ElementsAre("f1"));
  EXPECT_TRUE(Read().empty());
  EXPECT_EQ(cursor_->position(), 1U) << "what is held back was not delivered";
  clock_.Advance(1s);
  EXPECT_THAT(Read(), ElementsAre("g2-2x1", "f3"));
  EXPECT_EQ(cursor_->position(), 3U);
}

TEST_F(DeliveryCursorTest, LastFrameComesBeforeTheFinalState) {
  Open({"ffffs"}, {.min_frame_interval = 1h});
  EXPECT_THAT(Read(), ElementsAre("f1", "g2-3x2", "f4", "s5"));
}

TEST_F(DeliveryCursorTest, ProgressPassesAndTellsNoGap) {
  Open({"ffp", "c"}, {.min_frame_interval = 1h});
  EXPECT_THAT(Read(), ElementsAre("f1", "p0"));
  EXPECT_THAT(Read(), ElementsAre("g2-2x1", "c3"));
}

TEST_F(DeliveryCursorTest, SlowReaderIsSparedFramesUntilItHasCaughtUp) {
  Open({"fc", "ffc", "ff", "fc"}, {});
  EXPECT_THAT(Read(), ElementsAre("f1", "c2"));
  behind_ = true;
  EXPECT_THAT(Read(), ElementsAre("g3-4x2", "c5"));
  std::vector<LogRecord> none;
  EXPECT_THAT(Read(), ElementsAre("g6-8x3", "c9"));
  behind_ = false;
  EXPECT_TRUE(Read().empty());
}

TEST_F(DeliveryCursorTest, SlowReaderMayAskToBeDisconnectedOrToLag) {
  Open({"ffc"}, {.overflow = v1::DeliveryOptions::DISCONNECT});
  behind_ = true;
  EXPECT_TRUE(Read().empty());
  EXPECT_EQ(last_, LogCursor::Next::kSlow);
  Open({"ffc"}, {.overflow = v1::DeliveryOptions::LAG});
  EXPECT_THAT(Read(), ElementsAre("f1", "f2", "c3"));
}

}  // namespace
}  // namespace contact
