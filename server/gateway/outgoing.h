#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>
#include <string_view>
#include <vector>

#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {

/// Bytes that go out one after the other, and belong to somebody else.
using Parts = std::vector<std::string_view>;

/// The bytes of a buffer in one piece.
std::string Flat(const grpc::ByteBuffer& buffer);

/// A message of a stream in the dialect of its client. Bytes are not copied, JSON and base64 are
/// made.
class Outgoing {
 public:
  Outgoing(const RpcRequest& call, grpc::ByteBuffer message);

  /// INTERNAL if the message has no JSON. Then there is no frame.
  const grpc::Status& status() const { return status_; }
  /// Its frame. Valid while this lives.
  Parts parts() const;

 private:
  grpc::Status status_;
  std::string prefix_;
  std::vector<grpc::Slice> slices_;
  /// In the place of both for JSON and base64.
  std::string text_;
};

}  // namespace contact::gateway
