#include "storage/event_coding.h"

#include <google/protobuf/message.h>
#include <gtest/gtest.h>
#include <zstd.h>

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
  v1::Event parsed;
  ASSERT_TRUE(parsed.ParseFromString(payload));
  EXPECT_EQ(parsed.SerializeAsString(), event.SerializeAsString());
}

// Gives every field of one number or text a value that is not its default.
void Fill(google::protobuf::Message* message) {
  using Field = google::protobuf::FieldDescriptor;
  const auto* const reflection = message->GetReflection();
  for (int i = 0; i < message->GetDescriptor()->field_count(); ++i) {
    const Field* const field = message->GetDescriptor()->field(i);
    if (field->is_repeated() || field->cpp_type() == Field::CPPTYPE_MESSAGE) continue;
    switch (field->cpp_type()) {
      case Field::CPPTYPE_INT32:
        reflection->SetInt32(message, field, 8);
        break;
      case Field::CPPTYPE_INT64:
        reflection->SetInt64(message, field, 8);
        break;
      case Field::CPPTYPE_UINT64:
        reflection->SetUInt64(message, field, 8);
        break;
      case Field::CPPTYPE_BOOL:
        reflection->SetBool(message, field, true);
        break;
      case Field::CPPTYPE_STRING:
        reflection->SetString(message, field, std::string(64, 'x'));
        break;
      default:
        FAIL() << "no value for " << field->full_name();
    }
  }
}

// The encoder copies a chunk field by field; whoever adds one must not lose it there.
TEST(EventCodingTest, EveryFieldOfAChunkIsKept) {
  v1::Event event;
  Fill(&event);
  Fill(event.mutable_event_time());
  Fill(event.mutable_frame_chunk());
  Fill(event.mutable_frame_chunk()->add_columns());
  ASSERT_EQ(EncodeEvent(event).coding, Coding::kFrames);
  ExpectSame(event);
  EXPECT_EQ(v1::Event::descriptor()->field_count(), 14) << "an event has more than it had";
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
  event = Frames({{1, 2, 3}, {4, 5, 6}});
  event.mutable_frame_chunk()->mutable_columns(0)->add_numbers(7);
  ExpectSame(event);
}

TEST(EventCodingTest, ChunkOfManySamplesOfNothingComesBack) {
  v1::Event event;
  event.mutable_frame_chunk()->set_samples(std::numeric_limits<int>::max());
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

std::string Squeezed(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

// Bytes that look right from outside, but do not fit together, are refused and never overrun.
TEST(EventCodingTest, ChunkCutOrBentAnywhereIsRefusedOrAnEvent) {
  const std::string good = EncodeEvent(Frames({Sine(16), Sine(16)})).bytes;
  std::string inside(DecodedSize(Coding::kFrames, good), '\0');
  ZSTD_decompress(inside.data(), inside.size(), good.data(), good.size());
  std::string payload;
  ASSERT_TRUE(DecodePayload(Coding::kFrames, Squeezed(inside), &payload));
  v1::Event event;
  for (std::size_t size = 0; size < inside.size(); ++size) {
    const std::string cut = Squeezed(inside.substr(0, size));
    EXPECT_FALSE(DecodePayload(Coding::kFrames, cut, &payload)) << size;
    EXPECT_FALSE(DecodeEvent(Coding::kFrames, cut, &event)) << size;
  }
  for (std::size_t i = 0; i < inside.size(); ++i) {
    std::string bent = inside;
    bent[i] = static_cast<char>(bent[i] ^ 0x7f);
    v1::Event parsed;
    const bool whole = DecodePayload(Coding::kFrames, Squeezed(bent), &payload);
    if (!DecodeEvent(Coding::kFrames, Squeezed(bent), &event) || !whole) continue;
    ASSERT_TRUE(parsed.ParseFromString(payload)) << i;
    EXPECT_EQ(parsed.SerializeAsString(), event.SerializeAsString()) << i;
  }
}

}  // namespace
}  // namespace contact
