#include "gateway/call/outgoing.h"

#include <utility>

#include "gateway/protocol/codec.h"
#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

std::string_view View(const grpc::Slice& slice) {
  return {reinterpret_cast<const char*>(slice.begin()), slice.size()};
}

}  // namespace

std::string Flat(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  (void)buffer.Dump(&slices);
  std::string bytes;
  bytes.reserve(buffer.Length());
  for (const grpc::Slice& slice : slices) bytes += View(slice);
  return bytes;
}

Outgoing::Outgoing(const RpcRequest& call, grpc::ByteBuffer message) {
  const bool text = call.dialect.protocol == Dialect::Protocol::kGrpcWebText;
  if (!call.dialect.json && !text) {
    prefix_ = MessagePrefix(message.Length());
    (void)message.Dump(&slices_);
    return;
  }
  std::string bytes = Flat(message);
  message.Clear();
  if (call.dialect.json) {
    status_ = ToJson(*call.method->output_type(), std::exchange(bytes, {}), &bytes);
  }
  text_ = MessagePrefix(bytes.size()) + bytes;
  if (text) text_ = ToPaddedBase64(text_);
}

void Outgoing::AddTo(Parts* parts) const {
  for (const std::string* part : {&prefix_, &text_}) {
    if (!part->empty()) parts->emplace_back(*part);
  }
  for (const grpc::Slice& slice : slices_) parts->push_back(View(slice));
}

}  // namespace contact::gateway
