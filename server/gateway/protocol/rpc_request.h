#pragma once

#include <google/protobuf/descriptor.h>

#include <chrono>
#include <optional>
#include <string>
#include <variant>

#include "gateway/protocol/dialect.h"
#include "gateway/protocol/http.h"
#include "gateway/protocol/metadata.h"

namespace contact::gateway {

/// A call that a client asks for.
struct RpcRequest {
  const google::protobuf::MethodDescriptor* method = nullptr;
  /// As gRPC calls it.
  std::string path = {};
  Dialect dialect = {};
  /// The request's message, its bytes.
  std::string message = {};
  Metadata metadata = {};
  /// The time that the call has; nothing: any.
  std::optional<std::chrono::milliseconds> timeout = {};
};

/// True if the request is for a method of the contract.
bool IsRpc(const HttpRequest& request);

/// What a request that IsRpc asks for, by the specifications of Connect and gRPC-Web; or the answer
/// to one that does not keep to them.
std::variant<RpcRequest, HttpAnswer> ReadRpc(const HttpRequest& request);

/// The whole answer of a unary call that has ended so.
HttpAnswer AnswerOf(const RpcRequest& call, const std::string& message, const grpc::Status& status,
                    const Trailers& head, const Trailers& trailers);

/// The answer to a request whose body is larger than `most` bytes.
HttpAnswer TooLarge(const HttpRequest& head, std::size_t most);

}  // namespace contact::gateway
