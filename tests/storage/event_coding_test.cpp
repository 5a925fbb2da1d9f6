#include "storage/event_coding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace contact {
namespace {

v1::Event Frames(const std::vector<std::vector<double>>& columns) {
  v1::Event event;
  event.mutable_event_time()->set_seconds(1'700'000'000);
  v1::FrameChunk& chunk = *event.mutable_frame_chunk();
  chunk.set_first_sample(512);
  chunk.set_samples(static_cast<int>(columns.front().size()));
  for (const std::vector<double>& values : columns) {
    v1::FrameChunk::Column& column = *chunk.add_columns();
    column.set_name("B" + std::to_string(chunk.columns_size()));
    column.set_unit("m");
    column.mutable_values()->resize(8 * values.size());
    std::memcpy(column.mutable_values()->data(), values.data(), 8 * values.size());
  }
  return event;
}

std::vector<double> Sine(int samples) {
  std::vector<double> values;
  for (int i = 0; i < samples; ++i) values.push_back(std::sin(1e-3 * i));
  return values;
}

void ExpectSame(const v1::Event& event) {
  const CodedEvent coded = EncodeEvent(event);
  v1::Event decoded;
  ASSERT_TRUE(DecodeEvent(coded.coding, coded.bytes, &decoded));
  EXPECT_EQ(decoded.SerializeAsString(), event.SerializeAsString());
  std::string payload;
  ASSERT_TRUE(DecodePayload(coded.coding, coded.bytes, &payload));
  EXPECT_EQ(payload.size(), event.ByteSizeLong());
}

TEST(EventCodingTest, FramesComeBackBitByBit) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> odd = {-0.0,
                                   0.0,
                                   Limits::quiet_NaN(),
                                   -Limits::infinity(),
                                   Limits::denorm_min(),
                                   Limits::max(),
                                   Limits::lowest(),
                                   1.0};
  ExpectSame(Frames({odd}));
  ExpectSame(Frames({odd, odd, {8, 7, 6, 5, 4, 3, 2, 1}}));
  ExpectSame(Frames({{3.5}}));
  ExpectSame(Frames({Sine(256), Sine(256)}));
  for (int samples = 1; samples < 20; ++samples) ExpectSame(Frames({Sine(samples), Sine(samples)}));
}

TEST(EventCodingTest, OtherEventsAndOddChunksComeBack) {
  v1::Event event;
  ExpectSame(event);
  event.mutable_log_entry()->set_message("some words");
  ExpectSame(event);
  event.mutable_frame_chunk();
  ExpectSame(event);
  event = Frames({{1, 2, 3}, {4, 5, 6}});
  event.mutable_frame_chunk()->mutable_columns(1)->set_values("not three doubles");
  EXPECT_EQ(EncodeEvent(event).coding, Coding::kPlain);
  ExpectSame(event);
}

TEST(EventCodingTest, SmoothMotionTakesAThirdAtMost) {
  const v1::Event event = Frames({Sine(256), Sine(256), Sine(256)});
  const CodedEvent coded = EncodeEvent(event);
  EXPECT_EQ(coded.coding, Coding::kFrames);
  EXPECT_LT(coded.bytes.size(), event.ByteSizeLong() / 3);
  EXPECT_NEAR(static_cast<double>(DecodedSize(coded.coding, coded.bytes)),
              static_cast<double>(event.ByteSizeLong()), 64);
}

TEST(EventCodingTest, SameEventGivesTheSameBytes) {
  const v1::Event event = Frames({Sine(256), Sine(256)});
  EXPECT_EQ(EncodeEvent(event).bytes, EncodeEvent(event).bytes);
}

TEST(EventCodingTest, GarbageIsRefused) {
  const std::string good = EncodeEvent(Frames({Sine(256)})).bytes;
  v1::Event event;
  EXPECT_FALSE(DecodeEvent(Coding::kFrames, "", &event));
  EXPECT_FALSE(DecodeEvent(Coding::kFrames, "some words", &event));
  EXPECT_FALSE(DecodeEvent(Coding::kFrames, good.substr(0, good.size() / 2), &event));
  EXPECT_FALSE(DecodeEvent(static_cast<Coding>(7), good, &event));
}

}  // namespace
}  // namespace contact
