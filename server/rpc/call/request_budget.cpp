#include "rpc/call/request_budget.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/slice.h>

namespace contact {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

// A number takes 9 bytes, so 2 MiB of numbers, what a request may have by default, are 233,000
// fields.
constexpr std::int64_t kMostFields = 1 << 19;
// 2 MiB of entries with one number each are 190,000. 327,680 empty contacts, which are the largest
// messages, take 53 MiB (system/oversize).
constexpr std::int64_t kMostMessages = 5 << 16;
// Memory of a parsed field beside its bytes: that of an empty contact and its place in the list.
constexpr std::int64_t kFieldBytes = 152;
constexpr int kDeepest = 100;  // As protobuf's own limit.

// Counts the fields up to the limit of `in`. False: they are no message of this type; of unknown
// fields, for which there is no type, only the place counts.
bool Count(CodedInputStream* in, const Descriptor& type, int depth, const FieldCount& most,
           FieldCount* count) {
  if (depth > kDeepest) return false;
  while (const std::uint32_t tag = in->ReadTag()) {
    if (++count->fields > most.fields) return true;
    const auto kind = WireFormatLite::GetTagWireType(tag);
    // Groups are unknown to the contract; what is in them counts as if it stood beside them.
    if (kind == WireFormatLite::WIRETYPE_START_GROUP || kind == WireFormatLite::WIRETYPE_END_GROUP)
      continue;
    const auto* field = type.FindFieldByNumber(WireFormatLite::GetTagFieldNumber(tag));
    const Descriptor* inner = field == nullptr ? nullptr : field->message_type();
    if (kind != WireFormatLite::WIRETYPE_LENGTH_DELIMITED || inner == nullptr) {
      if (!WireFormatLite::SkipField(in, tag)) return false;
      continue;
    }
    if (++count->messages > most.messages) return true;
    std::uint32_t length = 0;
    if (!in->ReadVarint32(&length)) return false;
    if (length > static_cast<std::uint32_t>(in->BytesUntilLimit())) return false;
    const auto limit = in->PushLimit(static_cast<int>(length));
    if (!Count(in, *inner, depth + 1, most, count)) return false;
    if (count->fields > most.fields || count->messages > most.messages) return true;
    if (in->BytesUntilLimit() > 0) return false;
    in->PopLimit(limit);
  }
  return in->ConsumedEntireMessage();
}

Error NoMessage(const google::protobuf::Message& message) {
  return MakeError(Reason::kFieldInvalid,
                   fmt::format("the request is no {}", message.GetDescriptor()->name()));
}

Error TooMany(std::int64_t most, const char* what) {
  return MakeError(Reason::kFieldInvalid,
                   fmt::format("the request has more than {} {}", most, what));
}

}  // namespace

std::optional<FieldCount> CountFields(std::string_view bytes, const Descriptor& type,
                                      const FieldCount& most) {
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                      static_cast<int>(bytes.size()));
  FieldCount count;
  if (!Count(&in, type, 0, most, &count)) return std::nullopt;
  return count;
}

std::optional<Error> RequestBudget::Parse(const grpc::ByteBuffer& bytes,
                                          google::protobuf::Message* message,
                                          std::shared_ptr<const void>* place) {
  grpc::Slice slice;
  if (!bytes.DumpToSingleSlice(&slice).ok()) return NoMessage(*message);
  const std::string_view text(reinterpret_cast<const char*>(slice.begin()), slice.size());
  const auto count = CountFields(text, *message->GetDescriptor(), {kMostFields, kMostMessages});
  if (!count) return NoMessage(*message);
  if (count->fields > kMostFields) return TooMany(kMostFields, "fields");
  if (count->messages > kMostMessages) return TooMany(kMostMessages, "messages");
  *place = Take(static_cast<std::int64_t>(slice.size()) + count->fields * kFieldBytes);
  if (!*place) {
    return MakeError(Reason::kRateLimited,
                     "requests that are not answered yet take all the memory "
                     "that there is for them");
  }
  if (!message->ParseFromArray(text.data(), static_cast<int>(text.size()))) {
    return NoMessage(*message);
  }
  return std::nullopt;
}

std::shared_ptr<const void> RequestBudget::Take(std::int64_t bytes) {
  const MutexLock lock(mutex_);
  if (taken_ > 0 && taken_ + bytes > most_) return nullptr;
  taken_ += bytes;
  return {this, [this, bytes](const void*) {
            const MutexLock given(mutex_);
            taken_ -= bytes;
          }};
}

}  // namespace contact
