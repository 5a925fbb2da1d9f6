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

/// True if the request is a call in gRPC's own protocol, of whatever method.
bool IsNative(const HttpRequest& request);

/// The methods of HTTP that the target of a request takes, as `Allow` has them.
std::string AllowedMethods(const HttpRequest& request);

/// What a request that IsRpc asks for, by the specifications of Connect and gRPC-Web; or the answer
/// to one that does not keep to them.
std::variant<RpcRequest, HttpAnswer> ReadRpc(const HttpRequest& request);

/// What the head of a request that IsNative asks for: a call without `method`, whose messages stand
/// in the body; or the answer to one that cannot be read.
std::variant<RpcRequest, HttpAnswer> ReadNativeHead(const HttpRequest& request);

/// The whole answer of a unary call that has ended so.
HttpAnswer AnswerOf(const RpcRequest& call, std::string message, const grpc::Status& status,
                    const Trailers& head, const Trailers& trailers);

/// The answer to a request that is refused for this error, as the call's protocol says it; `status`
/// and the error's words to what is no call.
HttpAnswer Refused(const HttpRequest& head, int status, const grpc::Status& why);

/// Refused because there is no room for it: RESOURCE_EXHAUSTED.
HttpAnswer Exhausted(const HttpRequest& head, int status, const std::string& words);

/// What Exhausted says where the answer is what there is no room for.
inline constexpr char kNoRoom[] = "too many large answers are being sent; ask again later";

}  // namespace contact::gateway
