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

// Several times what the largest scenario has.
constexpr std::int64_t kMostFields = 1 << 19;
// Memory of a parsed field beside its bytes: that of an empty contact.
constexpr std::int64_t kFieldBytes = 130;
constexpr int kDeepest = 100;  // As protobuf's own limit.

// Counts the fields up to the limit of `in`. False: they are no message of this type; of unknown
// fields, for which there is no type, only the place counts.
bool Count(CodedInputStream* in, const Descriptor& type, int depth, std::int64_t most,
           std::int64_t* fields) {
  if (depth > kDeepest) return false;
  while (const std::uint32_t tag = in->ReadTag()) {
    if (++*fields > most) return true;
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
    std::uint32_t length = 0;
    if (!in->ReadVarint32(&length)) return false;
    if (length > static_cast<std::uint32_t>(in->BytesUntilLimit())) return false;
    const auto limit = in->PushLimit(static_cast<int>(length));
    if (!Count(in, *inner, depth + 1, most, fields)) return false;
    if (*fields > most) return true;
    if (in->BytesUntilLimit() > 0) return false;
    in->PopLimit(limit);
  }
  return in->ConsumedEntireMessage();
}

Error NoMessage(const google::protobuf::Message& message) {
  return MakeError(Reason::kFieldInvalid,
                   fmt::format("the request is no {}", message.GetDescriptor()->name()));
}

}  // namespace

std::optional<std::int64_t> CountFields(std::string_view bytes, const Descriptor& type,
                                        std::int64_t most) {
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                      static_cast<int>(bytes.size()));
  std::int64_t fields = 0;
  if (!Count(&in, type, 0, most, &fields)) return std::nullopt;
  return fields;
}

std::optional<Error> RequestBudget::Parse(const grpc::ByteBuffer& bytes,
                                          google::protobuf::Message* message,
                                          std::shared_ptr<const void>* place) {
  grpc::Slice slice;
  if (!bytes.DumpToSingleSlice(&slice).ok()) return NoMessage(*message);
  const std::string_view text(reinterpret_cast<const char*>(slice.begin()), slice.size());
  const auto fields = CountFields(text, *message->GetDescriptor(), kMostFields);
  if (!fields) return NoMessage(*message);
  if (*fields > kMostFields) {
    return MakeError(Reason::kFieldInvalid,
                     fmt::format("the request has more than {} fields", kMostFields));
  }
  *place = Take(static_cast<std::int64_t>(slice.size()) + *fields * kFieldBytes);
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
