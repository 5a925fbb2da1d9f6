#include "rpc/stream/stream_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include "test_server.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// Counts what the loop does to it.
class FakeStream final : public Stream {
 public:
  void Poke() override { ++pokes; }
  void Drain() override { ++drains; }
  bool Tick(std::chrono::steady_clock::time_point now) override {
    ticked = now;
    ++ticks;
    return slow;
  }

  std::atomic<int> pokes = 0;
  std::atomic<int> drains = 0;
  std::atomic<int> ticks = 0;
  std::atomic<bool> slow = false;
  std::atomic<std::chrono::steady_clock::time_point> ticked = {};
};

class StreamLoopTest : public testing::Test {
 protected:
  ~StreamLoopTest() override { loop_.Stop(); }

  FakeClock clock_;
  StreamLoop loop_{clock_, 40ms};  // A tick takes 10 ms.
};

TEST_F(StreamLoopTest, WokenStreamIsPokedAndOthersAreNot) {
  const auto woken = std::make_shared<FakeStream>();
  const auto other = std::make_shared<FakeStream>();
  loop_.Add(woken);
  loop_.Add(other);
  loop_.Wake(woken);
  EXPECT_TRUE(Eventually([&] { return woken->pokes == 1; }));
  EXPECT_EQ(other->pokes, 0);
}

TEST_F(StreamLoopTest, TicksTellTheTimeOfTheClock) {
  const auto stream = std::make_shared<FakeStream>();
  clock_.Advance(1h);
  loop_.Add(stream);
  EXPECT_TRUE(Eventually([&] { return stream->ticks > 1; }));
  EXPECT_EQ(stream->ticked.load(), clock_.Elapsed());
}

TEST_F(StreamLoopTest, SlowStreamsAreCountedAtEachTick) {
  const auto stream = std::make_shared<FakeStream>();
  stream->slow = true;
  loop_.Add(stream);
  EXPECT_TRUE(Eventually([&] { return loop_.metrics()->slow == 1; }));
  stream->slow = false;
  EXPECT_TRUE(Eventually([&] { return loop_.metrics()->slow == 0; }));
}

TEST_F(StreamLoopTest, DrainReachesStreamsOfNowAndOfLater) {
  const auto before = std::make_shared<FakeStream>();
  const auto after = std::make_shared<FakeStream>();
  loop_.Add(before);
  loop_.Drain();
  loop_.Add(after);
  EXPECT_EQ(before->drains, 1);
  EXPECT_EQ(after->drains, 1);
}

TEST_F(StreamLoopTest, DestroyedStreamIsForgotten) {
  auto stream = std::make_shared<FakeStream>();
  loop_.Add(stream);
  EXPECT_EQ(loop_.streams(), 1U);
  const std::weak_ptr<FakeStream> weak = stream;
  stream.reset();
  EXPECT_TRUE(Eventually([&] { return weak.expired(); })) << "a tick may hold it";
  loop_.Wake(weak);
  EXPECT_EQ(loop_.streams(), 0U);
}

TEST_F(StreamLoopTest, NothingIsTickedOnceStopped) {
  const auto stream = std::make_shared<FakeStream>();
  loop_.Add(stream);
  loop_.Stop();
  const int ticks = stream->ticks;
  loop_.Wake(stream);
  EXPECT_EQ(stream->ticks, ticks);
  EXPECT_EQ(stream->pokes, 0);
}

}  // namespace
}  // namespace contact
