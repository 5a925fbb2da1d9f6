#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>
#include <string_view>
#include <vector>

#include "gateway/net/socket.h"
#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {

/// The bytes of a buffer in one piece.
std::string Flat(const grpc::ByteBuffer& buffer);

/// A message of a stream in the dialect of its client. Bytes are not copied, JSON and base64 are
/// made.
class Outgoing {
 public:
  Outgoing(const RpcRequest& call, grpc::ByteBuffer message);

  /// INTERNAL if the message has no JSON. Then there is no frame.
  const grpc::Status& status() const { return status_; }
  /// Appends its frame, which is valid while this lives and is not moved.
  void AddTo(Parts* parts) const;

 private:
  grpc::Status status_;
  std::string prefix_;
  std::vector<grpc::Slice> slices_;
  /// In the place of both for JSON and base64.
  std::string text_;
};

}  // namespace contact::gateway
