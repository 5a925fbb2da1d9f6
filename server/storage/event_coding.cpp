#include "storage/event_coding.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace contact {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they are");

using google::protobuf::internal::WireFormatLite;

// Measured in README.md: higher levels cost more time than they save space.
constexpr int kLevel = -1;
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

// Bytes that nobody has filled with zeros first.
struct Buffer {
  explicit Buffer(std::size_t room) : data(std::make_unique_for_overwrite<char[]>(room)) {}

  std::unique_ptr<char[]> data;
  std::size_t size = 0;
};

std::string Compress(const Buffer& bytes) {
  // To make one costs as much as a chunk of a small job.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  ZSTD_freeCCtx);
  const std::size_t room = ZSTD_compressBound(bytes.size);
  const Buffer out(room);
  const std::size_t size =
      ZSTD_compressCCtx(context.get(), out.data.get(), room, bytes.data.get(), bytes.size, kLevel);
  return {out.data.get(), ZSTD_isError(size) != 0 ? 0 : size};
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

// The event without its values, which are most of it.
v1::Event WithoutValues(const v1::Event& event) {
  v1::Event rest;
  rest.set_sequence(event.sequence());
  if (event.has_event_time()) *rest.mutable_event_time() = event.event_time();
  const v1::FrameChunk& chunk = event.frame_chunk();
  v1::FrameChunk& bare = *rest.mutable_frame_chunk();
  bare.set_first_sample(chunk.first_sample());
  bare.set_samples(chunk.samples());
  for (const v1::FrameChunk::Column& column : chunk.columns()) {
    v1::FrameChunk::Column& head = *bare.add_columns();
    head.set_name(column.name());
    head.set_quantity(column.quantity());
    head.set_unit(column.unit());
  }
  return rest;
}

// Length of the event without its values, that event, and the planes of the values.
Buffer Rearrange(const v1::Event& event) {
  const v1::Event rest = WithoutValues(event);
  const auto length = static_cast<std::uint32_t>(rest.ByteSizeLong());
  const auto samples = static_cast<std::size_t>(event.frame_chunk().samples());
  const auto columns = static_cast<std::size_t>(event.frame_chunk().columns_size());
  Buffer bytes(sizeof length + length + samples * columns * kDouble);
  std::memcpy(bytes.data.get(), &length, sizeof length);
  rest.SerializeToArray(bytes.data.get() + sizeof length, static_cast<int>(length));
  bytes.size = sizeof length + length;
  char* planes = bytes.data.get() + bytes.size;
  for (const v1::FrameChunk::Column& column : event.frame_chunk().columns()) {
    SplitColumn(column.values(), samples * columns, planes);
    planes += samples;
  }
  bytes.size += samples * columns * kDouble;
  return bytes;
}

void AppendVarint(std::uint64_t value, std::string* text) {
  for (; value > 127; value >>= 7) text->push_back(static_cast<char>(value | 128));
  text->push_back(static_cast<char>(value));
}

// Tag and length of a field that is so long.
void AppendHead(int field, std::size_t size, std::string* text) {
  AppendVarint(WireFormatLite::MakeTag(field, WireFormatLite::WIRETYPE_LENGTH_DELIMITED), text);
  AppendVarint(size, text);
}

// One field of a serialised message after the other.
class Fields {
 public:
  explicit Fields(std::string_view bytes)
      : bytes_(bytes),
        stream_(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                static_cast<int>(bytes.size())) {}

  // False after the last one, and where there is none.
  bool Next() {
    start_ = Position();
    const std::uint32_t tag = stream_.ReadTag();
    if (tag == 0) return false;
    number_ = WireFormatLite::GetTagFieldNumber(tag);
    begin_ = Position();
    if (WireFormatLite::GetTagWireType(tag) == WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      std::uint32_t length = 0;
      good_ = stream_.ReadVarint32(&length);
      begin_ = Position();
      good_ = good_ && stream_.Skip(static_cast<int>(length));
    } else {
      good_ = WireFormatLite::SkipField(&stream_, tag);
    }
    return good_;
  }
  int number() const { return number_; }
  std::string_view whole() const { return bytes_.substr(start_, Position() - start_); }
  // Without its tag, and its length if it has one.
  std::string_view content() const { return bytes_.substr(begin_, Position() - begin_); }
  // Of a field that is one.
  std::uint64_t Number() const {
    const std::string_view bytes = content();
    google::protobuf::io::CodedInputStream stream(
        reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<int>(bytes.size()));
    std::uint64_t number = 0;
    return stream.ReadVarint64(&number) ? number : 0;
  }
  bool complete() const { return good_ && Position() == bytes_.size(); }

 private:
  std::size_t Position() const { return static_cast<std::size_t>(stream_.CurrentPosition()); }

  const std::string_view bytes_;
  google::protobuf::io::CodedInputStream stream_;
  std::size_t start_ = 0;
  std::size_t begin_ = 0;
  int number_ = 0;
  bool good_ = true;
};

// An event without its values, taken apart where they belong. Not parsed: to fill a message in and
// to serialise it takes three times as long.
struct Parts {
  std::string event;  // All but the chunk.
  std::string chunk;  // All but the columns.
  std::uint64_t samples = 0;
  std::vector<std::string_view> columns;
};

bool TakeApart(std::string_view bytes, Parts* parts) {
  Fields event(bytes);
  std::string_view chunk;
  while (event.Next()) {
    if (event.number() == v1::Event::kFrameChunkFieldNumber) {
      chunk = event.content();
    } else {
      parts->event += event.whole();
    }
  }
  Fields fields(chunk);
  while (fields.Next()) {
    if (fields.number() == v1::FrameChunk::kSamplesFieldNumber) parts->samples = fields.Number();
    if (fields.number() == v1::FrameChunk::kColumnsFieldNumber) {
      parts->columns.push_back(fields.content());
    } else {
      parts->chunk += fields.whole();
    }
  }
  return event.complete() && fields.complete();
}

// The event, serialised, with these planes as its values.
std::string Compose(const Parts& parts, std::string_view planes) {
  const std::size_t stride = planes.size() / kDouble;
  const std::size_t size = parts.samples * kDouble;
  std::vector<std::string> heads;
  std::size_t chunk = parts.chunk.size() + planes.size();
  for (const std::string_view column : parts.columns) {
    std::string rest(column);
    AppendHead(v1::FrameChunk::Column::kValuesFieldNumber, size, &rest);
    AppendHead(v1::FrameChunk::kColumnsFieldNumber, rest.size() + size, &heads.emplace_back());
    heads.back() += rest;
    chunk += heads.back().size();
  }
  std::string out = parts.event;
  AppendHead(v1::Event::kFrameChunkFieldNumber, chunk, &out);
  out += parts.chunk;
  std::size_t at = out.size();
  out.resize(at + chunk - parts.chunk.size());
  const char* plane = planes.data();
  for (const std::string& head : heads) {
    head.copy(out.data() + at, head.size());
    at += head.size();
    JoinColumn(plane, stride, parts.samples, out.data() + at);
    at += size;
    plane += parts.samples;
  }
  return out;
}

bool Restore(std::string_view bytes, std::string* payload) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof length) return false;
  std::memcpy(&length, bytes.data(), sizeof length);
  bytes.remove_prefix(sizeof length);
  Parts parts;
  if (bytes.size() < length || !TakeApart(bytes.substr(0, length), &parts)) return false;
  bytes.remove_prefix(length);
  if (bytes.size() % kDouble != 0 || parts.samples > kMaxDecoded ||
      bytes.size() / kDouble != parts.samples * parts.columns.size()) {
    return false;
  }
  *payload = Compose(parts, bytes);
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

}  // namespace contact
