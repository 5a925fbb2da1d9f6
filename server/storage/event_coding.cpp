#include "storage/event_coding.h"

#include <google/protobuf/unknown_field_set.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/column_planes.h"

namespace contact {
namespace {

static_assert(std::endian::native == std::endian::little, "lengths are stored as they are");

using google::protobuf::UnknownField;
using google::protobuf::UnknownFieldSet;

// Measured in README.md: higher levels cost more time than they save space.
constexpr int kLevel = -1;
// Far more than a frame chunk has; a larger size is not ours.
constexpr std::size_t kMaxDecoded = std::size_t{1} << 30;
constexpr std::size_t kDouble = sizeof(double);

// Bytes that nobody has filled with zeros first.
struct Buffer {
  explicit Buffer(std::size_t bytes)
      : data(std::make_unique_for_overwrite<char[]>(bytes)), size(bytes) {}

  std::unique_ptr<char[]> data;
  std::size_t size;
};

std::string Compress(const Buffer& bytes) {
  // Making one takes as long as compressing a chunk of a small job.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  ZSTD_freeCCtx);
  const Buffer out(ZSTD_compressBound(bytes.size));
  const std::size_t size = ZSTD_compressCCtx(context.get(), out.data.get(), out.size,
                                             bytes.data.get(), bytes.size, kLevel);
  return {out.data.get(), ZSTD_isError(size) != 0 ? 0 : size};
}

// Empty if `bytes` are no zstd frame.
Buffer Decompress(const std::string& bytes) {
  // Making one takes longer than decompressing a small chunk.
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                                  ZSTD_freeDCtx);
  const std::size_t size = DecodedSize(Coding::kFrames, bytes);
  Buffer out(size > kMaxDecoded ? 0 : size);
  const std::size_t got =
      ZSTD_decompressDCtx(context.get(), out.data.get(), out.size, bytes.data(), bytes.size());
  return got == size ? std::move(out) : Buffer(0);
}

bool HasWholeColumns(const v1::FrameChunk& chunk) {
  const auto size = static_cast<std::size_t>(chunk.samples()) * kDouble;
  return chunk.samples() > 0 && !chunk.columns().empty() &&
         std::ranges::all_of(chunk.columns(), [size](const auto& column) {
           return column.values().size() == size && column.numbers().empty();
         });
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
  bare.set_columns_follow(chunk.columns_follow());
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
  char* planes = bytes.data.get() + sizeof length + length;
  for (const v1::FrameChunk::Column& column : event.frame_chunk().columns()) {
    SplitColumn(column.values(), samples * columns, planes);
    planes += samples;
  }
  return bytes;
}

void AppendVarint(std::uint64_t value, std::string* text) {
  for (; value > 127; value >>= 7) text->push_back(static_cast<char>(value | 128));
  text->push_back(static_cast<char>(value));
}

// Tag and length of a field with `size` bytes of text or message.
void AppendHead(int field, std::size_t size, std::string* text) {
  constexpr std::uint64_t kLengthDelimited = 2;  // The wire type.
  AppendVarint(static_cast<std::uint64_t>(field) << 3U | kLengthDelimited, text);
  AppendVarint(size, text);
}

// An event without its values, taken apart where they belong. Not parsed: filling a message in and
// serialising it takes three times as long.
struct Parts {
  std::string event;  // All but the chunk.
  std::string chunk;  // All but the columns.
  std::uint64_t samples = 0;
  std::vector<std::string> columns;
};

// Removes the messages in a field of `fields` and returns them in their order.
std::vector<std::string> Take(int number, UnknownFieldSet* fields) {
  std::vector<std::string> taken;
  for (int i = 0; i < fields->field_count(); ++i) {
    UnknownField& field = *fields->mutable_field(i);
    if (field.number() != number || field.type() != UnknownField::TYPE_LENGTH_DELIMITED) continue;
    taken.push_back(std::move(*field.mutable_length_delimited()));
  }
  fields->DeleteByNumber(number);
  return taken;
}

// False if `bytes` are no event with one chunk.
bool TakeApart(std::string_view bytes, Parts* parts) {
  UnknownFieldSet event, chunk;
  if (!event.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return false;
  const std::vector<std::string> chunks = Take(v1::Event::kFrameChunkFieldNumber, &event);
  if (chunks.size() != 1 || !chunk.ParseFromString(chunks.front())) return false;
  parts->columns = Take(v1::FrameChunk::kColumnsFieldNumber, &chunk);
  for (int i = 0; i < chunk.field_count(); ++i) {
    const UnknownField& field = chunk.field(i);
    const bool samples = field.number() == v1::FrameChunk::kSamplesFieldNumber;
    if (samples && field.type() == UnknownField::TYPE_VARINT) parts->samples = field.varint();
  }
  return event.SerializeToString(&parts->event) && chunk.SerializeToString(&parts->chunk);
}

// The event, serialised, with these planes as its values.
std::string Compose(Parts parts, std::string_view planes) {
  const std::size_t size = parts.samples * kDouble;
  std::vector<std::string> heads;  // Of each column: all but the values.
  std::size_t chunk = parts.chunk.size() + planes.size();
  for (std::string& rest : parts.columns) {
    AppendHead(v1::FrameChunk::Column::kValuesFieldNumber, size, &rest);
    std::string& head = heads.emplace_back();
    AppendHead(v1::FrameChunk::kColumnsFieldNumber, rest.size() + size, &head);
    head += rest;
    chunk += head.size();
  }
  std::string out = parts.event;
  AppendHead(v1::Event::kFrameChunkFieldNumber, chunk, &out);
  out.reserve(out.size() + chunk);
  out += parts.chunk;
  const char* plane = planes.data();
  for (const std::string& head : heads) {
    out += head;
    out.resize(out.size() + size);
    JoinColumn(plane, planes.size() / kDouble, parts.samples, out.data() + out.size() - size);
    plane += parts.samples;
  }
  return out;
}

// What Rearrange has made, taken apart.
struct Rearranged {
  std::string_view rest;
  std::string_view planes;
};

// Nothing if `bytes` are too short.
std::optional<Rearranged> AsRearranged(std::string_view bytes) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof length) return std::nullopt;
  std::memcpy(&length, bytes.data(), sizeof length);
  bytes.remove_prefix(sizeof length);
  if (bytes.size() < length) return std::nullopt;
  return Rearranged{bytes.substr(0, length), bytes.substr(length)};
}

bool Restore(std::string_view bytes, std::string* payload) {
  const std::optional<Rearranged> from = AsRearranged(bytes);
  Parts parts;
  if (!from || !TakeApart(from->rest, &parts)) return false;
  if (from->planes.size() % kDouble != 0 || parts.samples > kMaxDecoded ||
      from->planes.size() / kDouble != parts.samples * parts.columns.size()) {
    return false;
  }
  *payload = Compose(std::move(parts), from->planes);
  return true;
}

// As Restore, but without a detour over the serialised message.
bool Restore(std::string_view bytes, v1::Event* event) {
  const std::optional<Rearranged> from = AsRearranged(bytes);
  if (!from || !event->ParseFromArray(from->rest.data(), static_cast<int>(from->rest.size())) ||
      !event->has_frame_chunk() || event->frame_chunk().samples() < 0) {
    return false;
  }
  v1::FrameChunk& chunk = *event->mutable_frame_chunk();
  const auto samples = static_cast<std::size_t>(chunk.samples());
  const std::size_t stride = samples * static_cast<std::size_t>(chunk.columns_size());
  if (from->planes.size() != stride * kDouble) return false;
  const char* plane = from->planes.data();
  for (v1::FrameChunk::Column& column : *chunk.mutable_columns()) {
    column.mutable_values()->resize(samples * kDouble);
    JoinColumn(plane, stride, samples, column.mutable_values()->data());
    plane += samples;
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

bool DecodePayload(Coding coding, std::string bytes, std::string* payload) {
  if (coding == Coding::kPlain) {
    *payload = std::move(bytes);
    return true;
  }
  if (coding != Coding::kFrames) return false;
  const Buffer rearranged = Decompress(bytes);
  return Restore({rearranged.data.get(), rearranged.size}, payload);
}

bool DecodeEvent(Coding coding, const std::string& bytes, v1::Event* event) {
  if (coding == Coding::kPlain) return event->ParseFromString(bytes);
  if (coding != Coding::kFrames) return false;
  const Buffer rearranged = Decompress(bytes);
  return Restore({rearranged.data.get(), rearranged.size}, event);
}

std::size_t DecodedSize(Coding coding, const std::string& bytes) {
  if (coding == Coding::kPlain) return bytes.size();
  return ZSTD_getFrameContentSize(bytes.data(), bytes.size());
}

}  // namespace contact
