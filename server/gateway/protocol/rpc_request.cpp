#include "gateway/protocol/rpc_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/spelling.h"
#include "gateway/protocol/codec.h"
#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

using google::protobuf::MethodDescriptor;
using grpc::Status;
using grpc::StatusCode;
using Protocol = Dialect::Protocol;

constexpr char kAcceptPost[] =
    "application/json, application/proto, application/connect+json, application/connect+proto, "
    "application/grpc-web, application/grpc-web+proto, application/grpc-web+json, "
    "application/grpc-web-text, application/grpc-web-text+proto";

HttpAnswer WithHeader(HttpAnswer answer, const char* name, std::string value) {
  answer.headers.emplace_back(name, std::move(value));
  return answer;
}

// Names what this method is called with; the header has all that there are.
HttpAnswer WrongType(const HttpRequest& request, const MethodDescriptor& method) {
  const char* connect = method.server_streaming() ? "connect+" : "";
  const std::string words =
      request.method == "GET"
          ? "encoding in the query must be json or proto"
          : fmt::format(
                "the content-type of {} must be application/{}json, application/{}proto or "
                "one of gRPC-Web, and is {}",
                method.name(), connect, connect, Quoted(request.header("content-type")));
  return WithHeader(PlainAnswer(415, words), "accept-post", kAcceptPost);
}

// A deadline past this one is as good as none, and no clock overflows with it.
constexpr std::chrono::milliseconds kLongest = std::chrono::hours(24 * 365);

bool IsIdentity(std::string_view encoding) { return encoding.empty() || encoding == "identity"; }

Status Unimplemented(const std::string& words) { return {StatusCode::UNIMPLEMENTED, words}; }
Status Invalid(const std::string& words) { return {StatusCode::INVALID_ARGUMENT, words}; }

// The one message in the frames of a request.
Status OneMessage(const std::string& body, std::string* message) {
  auto frames = ToFrames(body);
  if (!frames) return Invalid("the body ends within a frame");
  if (frames->size() != 1) {
    return Unimplemented(
        fmt::format("the method takes one message, and {} are there", frames->size()));
  }
  const Frame& frame = frames->front();
  if ((frame.flags & kCompressed) != 0) return Unimplemented("compressed messages are not taken");
  if (frame.flags != 0) return Invalid(fmt::format("a frame has the flags {}", frame.flags));
  *message = std::move(frames->front().payload);
  return Status::OK;
}

// The name of the header by which the dialect says how a message is compressed.
const char* EncodingHeader(const Dialect& dialect) {
  if (dialect.grpc()) return "grpc-encoding";
  return dialect.framed() ? "connect-content-encoding" : "content-encoding";
}

// Looks at what the headers say of the protocol.
Status CheckHeaders(const HttpRequest& request, const Dialect& dialect) {
  if (!IsIdentity(request.header("content-encoding")) ||
      !IsIdentity(request.header(EncodingHeader(dialect)))) {
    return Unimplemented("compressed messages are not taken; send them as they are");
  }
  const std::string_view version = request.header("connect-protocol-version");
  if (!dialect.grpc() && !version.empty() && version != "1") {
    return Invalid("connect-protocol-version must be 1");
  }
  return Status::OK;
}

// Reads the deadline, if there is one.
Status ReadTimeout(const HttpRequest& request, RpcRequest* call) {
  const char* name = call->dialect.grpc() ? "grpc-timeout" : "connect-timeout-ms";
  if (!request.has(name)) return Status::OK;
  const std::string_view text = request.header(name);
  const auto time = call->dialect.grpc() ? GrpcTimeout(text) : ConnectTimeout(text);
  if (!time) return Invalid(fmt::format("{} is no time", name));
  call->timeout = std::min(std::chrono::milliseconds(*time), kLongest);
  return Status::OK;
}

// Reads what follows from the headers.
Status ReadHead(const HttpRequest& request, RpcRequest* call) {
  if (Status status = CheckHeaders(request, call->dialect); !status.ok()) return status;
  if (Status status = ReadTimeout(request, call); !status.ok()) return status;
  std::string mistake;
  auto metadata = ToMetadata(request.headers, &mistake);
  if (!metadata) return Invalid(mistake);
  call->metadata = *std::move(metadata);
  return Status::OK;
}

// Makes bytes of a message in JSON.
Status ToWire(const RpcRequest& call, std::string* message) {
  if (!call.dialect.json) return Status::OK;
  std::string bytes;
  // Nothing is an empty message, for a client that posts no body.
  const std::string& json = message->empty() ? "{}" : *message;
  Status status = FromJson(*call.method->input_type(), json, &bytes);
  *message = std::move(bytes);
  return status;
}

// Reads the message out of a body.
Status ReadBody(const std::string& body, RpcRequest* call) {
  std::string& message = call->message;
  if (!call->dialect.framed()) {
    message = body;
  } else if (call->dialect.protocol != Protocol::kGrpcWebText) {
    if (Status status = OneMessage(body, &message); !status.ok()) return status;
  } else {
    const auto bytes = FromBase64Stream(body);
    if (!bytes) return Invalid("the body is not base64");
    if (Status status = OneMessage(*bytes, &message); !status.ok()) return status;
  }
  return ToWire(*call, &message);
}

// Reads the message out of the query of a GET.
Status ReadQuery(const HttpRequest& request, RpcRequest* call) {
  const auto value = [&](const char* name) { return QueryValue(request.target, name); };
  if (value("connect").value_or("v1") != "v1") return Invalid("connect must be v1 in the query");
  if (!IsIdentity(value("compression").value_or(""))) {
    return Unimplemented("compressed messages are not taken; send them as they are");
  }
  const auto message = value("message");
  if (!message) return Invalid("the query has no message");
  call->message = *message;
  if (value("base64").value_or("") == "1") {
    auto bytes = FromBase64(*message);
    if (!bytes) return Invalid("the message in the query is not base64");
    call->message = *std::move(bytes);
  }
  return ToWire(*call, &call->message);
}

// The dialect of a request, that of a GET by its query.
std::optional<Dialect> DialectOfRequest(const HttpRequest& request) {
  if (request.method != "GET") {
    auto dialect = DialectOf(MediaType(request.header("content-type")));
    // HTTP/1.1 has no trailers that every proxy lets pass.
    if (dialect && dialect->protocol == Protocol::kGrpc && !request.http2) return std::nullopt;
    return dialect;
  }
  const std::string encoding = QueryValue(request.target, "encoding").value_or("");
  if (encoding != "json" && encoding != "proto") return std::nullopt;
  return DialectOf("application/" + encoding);
}

bool MayBeGot(const MethodDescriptor& method) {
  return HasNoSideEffects(method) && !method.server_streaming();
}

bool Fits(const Dialect& dialect, const MethodDescriptor& method) {
  if (dialect.grpc()) return true;
  return dialect.framed() == method.server_streaming();
}

}  // namespace

bool IsRpc(const HttpRequest& request) { return FindMethod(request.path()) != nullptr; }

bool IsNative(const HttpRequest& request) {
  const auto dialect = DialectOfRequest(request);
  return request.method == "POST" && dialect && dialect->protocol == Protocol::kGrpc;
}

std::string AllowedMethods(const HttpRequest& request) {
  const MethodDescriptor* method = FindMethod(request.path());
  if (method == nullptr) return "GET, HEAD, OPTIONS";
  return MayBeGot(*method) ? "GET, POST, OPTIONS" : "POST, OPTIONS";
}

std::variant<RpcRequest, HttpAnswer> ReadRpc(const HttpRequest& request) {
  RpcRequest call{.method = FindMethod(request.path()), .path = std::string(request.path())};
  const bool get = request.method == "GET";
  if (request.method != "POST" && !(get && MayBeGot(*call.method))) {
    return WithHeader(PlainAnswer(405, "the method is not called so"), "allow",
                      AllowedMethods(request));
  }
  const auto dialect = DialectOfRequest(request);
  if (!dialect || !Fits(*dialect, *call.method)) return WrongType(request, *call.method);
  call.dialect = *dialect;
  Status status = call.method->client_streaming() ? Unimplemented("clients cannot stream here")
                                                  : ReadHead(request, &call);
  if (status.ok()) status = get ? ReadQuery(request, &call) : ReadBody(request.body, &call);
  if (!status.ok()) return Failure(call.dialect, status);
  return call;
}

HttpAnswer AnswerOf(const RpcRequest& call, std::string message, const Status& status,
                    const Trailers& head, const Trailers& trailers) {
  const Dialect& dialect = call.dialect;
  if (!status.ok()) return Failure(dialect, status, trailers);
  HttpAnswer answer{200, HeadersOf(dialect), std::move(message)};
  std::ranges::move(ToHeaders(head, ""), std::back_inserter(answer.headers));
  if (dialect.json) {
    const Status printed =
        ToJson(*call.method->output_type(), std::exchange(answer.body, {}), &answer.body);
    if (!printed.ok()) return Failure(dialect, printed, trailers);
  }
  if (!dialect.framed()) {
    std::ranges::move(ToHeaders(trailers, "trailer-"), std::back_inserter(answer.headers));
    return answer;
  }
  answer.body.insert(0, MessagePrefix(answer.body.size()));
  if (dialect.protocol == Protocol::kGrpc) answer.trailers = TrailersOf(status, trailers);
  if (dialect.protocol == Protocol::kGrpcWebText) answer.body = ToPaddedBase64(answer.body);
  answer.body += EndOf(dialect, status, trailers);
  return answer;
}

std::variant<RpcRequest, HttpAnswer> ReadNativeHead(const HttpRequest& request) {
  RpcRequest call{.path = std::string(request.path()), .dialect = *DialectOfRequest(request)};
  if (const Status status = ReadHead(request, &call); !status.ok()) {
    return Failure(call.dialect, status);
  }
  return call;
}

HttpAnswer Refused(const HttpRequest& head, int status, const Status& why) {
  const auto dialect = DialectOfRequest(head);
  if (!(IsRpc(head) || IsNative(head)) || !dialect) return PlainAnswer(status, why.error_message());
  return Failure(*dialect, why);
}

HttpAnswer Exhausted(const HttpRequest& head, int status, const std::string& words) {
  return Refused(head, status, {StatusCode::RESOURCE_EXHAUSTED, words});
}

}  // namespace contact::gateway
