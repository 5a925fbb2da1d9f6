#include "storage/event_coding.h"

#include <zstd.h>

#include <bit>
#include <cstring>
#include <memory>
#include <string_view>
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

using Values = std::vector<std::uint64_t>;  // Bits of doubles.

// Smooth motion has small second differences, also between the bits of its doubles.
void AppendDifferences(std::string_view column, Values* values) {
  std::uint64_t before = 0;
  std::uint64_t difference_before = 0;
  for (std::size_t i = 0; i < column.size(); i += kDouble) {
    std::uint64_t value = 0;
    std::memcpy(&value, column.data() + i, kDouble);
    const std::uint64_t difference = value - before;
    values->push_back(difference - difference_before);
    before = value;
    difference_before = difference;
  }
}

std::string SumDifferences(const std::uint64_t* differences, std::size_t count) {
  std::string column(count * kDouble, '\0');
  std::uint64_t value = 0;
  std::uint64_t difference = 0;
  for (std::size_t i = 0; i < count; ++i) {
    difference += differences[i];
    value += difference;
    std::memcpy(column.data() + i * kDouble, &value, kDouble);
  }
  return column;
}

// The first bytes of all values, then their second bytes, and so on: like beside like.
void AppendPlanes(const Values& values, std::string* bytes) {
  const std::size_t start = bytes->size();
  bytes->resize(start + values.size() * kDouble);
  char* out = bytes->data() + start;
  for (std::size_t plane = 0; plane < kDouble; ++plane) {
    for (const std::uint64_t value : values) *out++ = static_cast<char>(value >> (8 * plane));
  }
}

Values JoinPlanes(std::string_view planes) {
  Values values(planes.size() / kDouble);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t plane = 0; plane < kDouble; ++plane) {
      const auto byte = static_cast<unsigned char>(planes[plane * values.size() + i]);
      values[i] |= std::uint64_t{byte} << (8 * plane);
    }
  }
  return values;
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

bool Decompress(const std::string& bytes, std::string* out) {
  const std::size_t expected = DecodedSize(Coding::kFrames, bytes);
  if (expected > kMaxDecoded) return false;
  out->resize(expected);
  return ZSTD_decompress(out->data(), expected, bytes.data(), bytes.size()) == expected;
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
  Values values;
  values.reserve(static_cast<std::size_t>(event.frame_chunk().columns_size()) *
                 static_cast<std::size_t>(event.frame_chunk().samples()));
  for (v1::FrameChunk::Column& column : *rest.mutable_frame_chunk()->mutable_columns()) {
    AppendDifferences(column.values(), &values);
    column.clear_values();
  }
  const auto length = static_cast<std::uint32_t>(rest.ByteSizeLong());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  rest.AppendToString(&bytes);
  AppendPlanes(values, &bytes);
  return bytes;
}

bool Restore(std::string_view bytes, v1::Event* event) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof length) return false;
  std::memcpy(&length, bytes.data(), sizeof length);
  bytes.remove_prefix(sizeof length);
  if (bytes.size() < length || !event->ParseFromArray(bytes.data(), static_cast<int>(length))) {
    return false;
  }
  v1::FrameChunk& chunk = *event->mutable_frame_chunk();
  const auto samples = static_cast<std::size_t>(chunk.samples());
  const Values values = JoinPlanes(bytes.substr(length));
  if (values.size() != samples * static_cast<std::size_t>(chunk.columns_size())) return false;
  const std::uint64_t* next = values.data();
  for (v1::FrameChunk::Column& column : *chunk.mutable_columns()) {
    column.set_values(SumDifferences(next, samples));
    next += samples;
  }
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

bool DecodeEvent(Coding coding, const std::string& bytes, v1::Event* event) {
  if (coding == Coding::kPlain) return event->ParseFromString(bytes);
  std::string rearranged;
  return coding == Coding::kFrames && Decompress(bytes, &rearranged) && Restore(rearranged, event);
}

std::size_t DecodedSize(Coding coding, const std::string& bytes) {
  if (coding == Coding::kPlain) return bytes.size();
  return ZSTD_getFrameContentSize(bytes.data(), bytes.size());
}

bool StoredEvent::Parse(v1::Event* event) const {
  return intact && DecodeEvent(coding, bytes, event);
}

bool StoredEvent::TakePayload(std::string* payload) {
  if (coding == Coding::kPlain) {
    *payload = std::move(bytes);
    return intact;
  }
  v1::Event event;
  return Parse(&event) && event.SerializeToString(payload);
}

}  // namespace contact
