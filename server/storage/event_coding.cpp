#include "storage/event_coding.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/records.h"

namespace contact {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they are");

// Measured in README.md: higher levels cost more time than they save space.
constexpr int kLevel = 3;
// Far more than a frame chunk has; a larger size is not ours.
constexpr std::size_t kMaxDecoded = std::size_t{1} << 30;
constexpr std::size_t kDouble = sizeof(std::uint64_t);

// Eight values at once: their bytes as a square, and the square turned.
constexpr std::size_t kBlock = 8;
using Block = std::array<std::uint64_t, kBlock>;

std::uint64_t Load(const char* from) {
  std::uint64_t value = 0;
  std::memcpy(&value, from, sizeof value);
  return value;
}

void Put(std::uint64_t value, char* to) { std::memcpy(to, &value, sizeof value); }

using Row = unsigned char __attribute__((vector_size(16)));

Row MergeLow(Row a, Row b) {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}

Row MergeHigh(Row a, Row b) {
  return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15,
                                 31);
}

// Byte j of value i becomes byte i of value j; its own inverse. To merge the halves of the block
// moves byte i to 2 i (mod 63): three times turn the six bits of i by half.
inline void Turn(Block& block) {
  std::array<Row, 4> rows;
  std::memcpy(&rows, &block, sizeof block);
  for (int i = 0; i < 3; ++i) {
    rows = {MergeLow(rows[0], rows[2]), MergeHigh(rows[0], rows[2]), MergeLow(rows[1], rows[3]),
            MergeHigh(rows[1], rows[3])};
  }
  std::memcpy(&block, &rows, sizeof block);
}

// Smooth motion has small second differences, also between the bits of its doubles.
class Differences {
 public:
  std::uint64_t Of(std::uint64_t value) {
    const std::uint64_t difference = value - value_;
    value_ = value;
    return difference - std::exchange(difference_, difference);
  }
  std::uint64_t Sum(std::uint64_t second) {
    difference_ += second;
    return value_ += difference_;
  }

 private:
  std::uint64_t value_ = 0;
  std::uint64_t difference_ = 0;
};

// The second differences of a column go to planes: the first bytes of all values of all columns,
// then their second bytes, and so on: like beside like. Planes are `stride` bytes apart.
void SplitColumn(std::string_view column, std::size_t stride, char* planes) {
  Differences differences;
  const std::size_t count = column.size() / kDouble;
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t some = std::min(kBlock, count - i);
    Block block{};
    for (std::size_t j = 0; j < some; ++j) {
      block[j] = differences.Of(Load(column.data() + (i + j) * kDouble));
    }
    Turn(block);
    for (std::size_t plane = 0; plane < kDouble; ++plane) {
      std::memcpy(planes + plane * stride + i, &block[plane], some);
    }
  }
}

// The reverse.
void JoinColumn(const char* planes, std::size_t stride, std::size_t count, char* column) {
  Differences differences;
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t some = std::min(kBlock, count - i);
    Block block{};
    for (std::size_t plane = 0; plane < kDouble; ++plane) {
      const char* const from = planes + plane * stride + i;
      if (some == kBlock) {
        block[plane] = Load(from);
      } else {
        std::memcpy(&block[plane], from, some);
      }
    }
    Turn(block);
    for (std::size_t j = 0; j < some; ++j) {
      Put(differences.Sum(block[j]), column + (i + j) * kDouble);
    }
  }
}

std::string Compress(const std::string& bytes) {
  // To make one costs as much as a chunk of a small job.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  ZSTD_freeCCtx);
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compressCCtx(context.get(), out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  out.resize(ZSTD_isError(size) != 0 ? 0 : size);
  return out;
}

// Nothing if it is no such frame.
std::unique_ptr<char[]> Decompress(const std::string& bytes, std::size_t* size) {
  // Making one takes longer than decompressing a small chunk.
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                                  &ZSTD_freeDCtx);
  *size = DecodedSize(Coding::kFrames, bytes);
  if (*size > kMaxDecoded) return nullptr;
  auto out = std::make_unique_for_overwrite<char[]>(*size);
  const std::size_t got =
      ZSTD_decompressDCtx(context.get(), out.get(), *size, bytes.data(), bytes.size());
  return got == *size ? std::move(out) : nullptr;
}

bool HasWholeColumns(const v1::FrameChunk& chunk) {
  const auto size = static_cast<std::size_t>(chunk.samples()) * kDouble;
  for (const v1::FrameChunk::Column& column : chunk.columns()) {
    if (column.values().size() != size) return false;
  }
  return chunk.samples() > 0;
}

// Length of the event without its values, that event, and the planes of the values.
std::string Rearrange(const v1::Event& event) {
  v1::Event rest = event;
  for (v1::FrameChunk::Column& column : *rest.mutable_frame_chunk()->mutable_columns()) {
    column.clear_values();
  }
  const auto length = static_cast<std::uint32_t>(rest.ByteSizeLong());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  rest.AppendToString(&bytes);
  const auto samples = static_cast<std::size_t>(event.frame_chunk().samples());
  const auto columns = static_cast<std::size_t>(event.frame_chunk().columns_size());
  const std::size_t start = bytes.size();
  bytes.resize(start + samples * columns * kDouble);
  char* planes = bytes.data() + start;
  for (const v1::FrameChunk::Column& column : event.frame_chunk().columns()) {
    SplitColumn(column.values(), samples * columns, planes);
    planes += samples;
  }
  return bytes;
}

using Columns = google::protobuf::RepeatedPtrField<v1::FrameChunk::Column>;

void AppendVarint(std::uint64_t value, std::string* text) {
  for (; value > 127; value >>= 7) text->push_back(static_cast<char>(value | 128));
  text->push_back(static_cast<char>(value));
}

// Tag and length of a field that is so long.
void AppendHead(int field, std::size_t size, std::string* text) {
  constexpr int kLengthDelimited = 2;
  AppendVarint(static_cast<std::uint64_t>(field) << 3 | kLengthDelimited, text);
  AppendVarint(size, text);
}

// Each as a field of its chunk, but for its values, which are last: `size` bytes.
std::vector<std::string> HeadsOf(const Columns& columns, std::size_t size) {
  std::vector<std::string> heads;
  for (const v1::FrameChunk::Column& column : columns) {
    std::string rest = column.SerializeAsString();
    AppendHead(v1::FrameChunk::Column::kValuesFieldNumber, size, &rest);
    AppendHead(v1::FrameChunk::kColumnsFieldNumber, rest.size() + size, &heads.emplace_back());
    heads.back() += rest;
  }
  return heads;
}

// The event, serialised, with these planes as its values. Written by hand: to fill a message in
// and to serialise it takes twice as long.
std::string Compose(v1::Event event, std::string_view planes, std::size_t samples) {
  v1::FrameChunk chunk;
  chunk.Swap(event.mutable_frame_chunk());
  event.clear_payload();
  Columns columns;
  columns.Swap(chunk.mutable_columns());
  const std::vector<std::string> heads = HeadsOf(columns, samples * kDouble);

  const std::string head = chunk.SerializeAsString();
  std::size_t size = head.size() + planes.size();
  for (const std::string& column : heads) size += column.size();
  std::string out = event.SerializeAsString();
  AppendHead(v1::Event::kFrameChunkFieldNumber, size, &out);
  out += head;
  std::size_t at = out.size();
  out.resize(at + size - head.size());
  const char* plane = planes.data();
  for (const std::string& column : heads) {
    column.copy(out.data() + at, column.size());
    at += column.size();
    JoinColumn(plane, planes.size() / kDouble, samples, out.data() + at);
    at += samples * kDouble;
    plane += samples;
  }
  return out;
}

bool Restore(std::string_view bytes, std::string* payload) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof length) return false;
  std::memcpy(&length, bytes.data(), sizeof length);
  bytes.remove_prefix(sizeof length);
  v1::Event event;
  if (bytes.size() < length || !event.ParseFromArray(bytes.data(), static_cast<int>(length))) {
    return false;
  }
  bytes.remove_prefix(length);
  const auto samples = static_cast<std::size_t>(event.frame_chunk().samples());
  const auto columns = static_cast<std::size_t>(event.frame_chunk().columns_size());
  if (bytes.size() % kDouble != 0 || bytes.size() / kDouble != samples * columns) return false;
  *payload = Compose(std::move(event), bytes, samples);
  return true;
}

}  // namespace

CodedEvent EncodeEvent(const v1::Event& event) {
  if (event.has_frame_chunk() && HasWholeColumns(event.frame_chunk())) {
    CodedEvent coded{Coding::kFrames, Compress(Rearrange(event))};
    if (!coded.bytes.empty()) return coded;
  }
  return {Coding::kPlain, event.SerializeAsString()};
}

bool DecodePayload(Coding coding, std::string bytes, std::string* payload) {
  if (coding == Coding::kPlain) {
    *payload = std::move(bytes);
    return true;
  }
  if (coding != Coding::kFrames) return false;
  std::size_t size = 0;
  const auto rearranged = Decompress(bytes, &size);
  return rearranged && Restore({rearranged.get(), size}, payload);
}

bool DecodeEvent(Coding coding, const std::string& bytes, v1::Event* event) {
  if (coding == Coding::kPlain) return event->ParseFromString(bytes);
  std::string payload;
  return DecodePayload(coding, bytes, &payload) && event->ParseFromString(payload);
}

std::size_t DecodedSize(Coding coding, const std::string& bytes) {
  if (coding == Coding::kPlain) return bytes.size();
  return ZSTD_getFrameContentSize(bytes.data(), bytes.size());
}

bool StoredEvent::Parse(v1::Event* event) const {
  return intact && DecodeEvent(coding, bytes, event);
}

bool StoredEvent::TakePayload(std::string* payload) {
  return intact && DecodePayload(coding, std::move(bytes), payload);
}

}  // namespace contact
