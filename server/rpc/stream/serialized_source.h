#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <chrono>
#include <memory>
#include <utility>

#include "jobs/job/callback.h"
#include "jobs/log/stream_source.h"

namespace contact {

/// A source of messages as one of their bytes: while a reader stalls, there is no message beside
/// the bytes that gRPC keeps of it.
template <class Message>
class SerializedSource final : public StreamSource<grpc::ByteBuffer> {
 public:
  using Messages = std::unique_ptr<StreamSource<Message>>;
  using Bytes = std::unique_ptr<StreamSource<grpc::ByteBuffer>>;

  explicit SerializedSource(Messages source) : source_(std::move(source)) {}

  /// What opens a stream of messages, if `opened` opens one of bytes.
  static Callback<Messages> Opens(Callback<Bytes> opened) {
    return [opened = std::move(opened)](Result<Messages> source) {
      if (!source.ok()) return opened(source.error());
      opened(Bytes(std::make_unique<SerializedSource>(std::move(source.value()))));
    };
  }

  StreamStep Read(grpc::ByteBuffer* out) override {
    Message message;
    StreamStep step = source_->Read(&message);
    if (!step.has_message) return step;
    const grpc::Slice bytes(message.SerializeAsString());
    *out = grpc::ByteBuffer(&bytes, 1);
    return step;
  }
  bool IsDue(std::chrono::steady_clock::time_point now) const override {
    return source_->IsDue(now);
  }

 private:
  const Messages source_;
};

}  // namespace contact
