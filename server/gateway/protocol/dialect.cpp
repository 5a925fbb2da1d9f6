#include "gateway/protocol/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "gateway/protocol/codes.h"
#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

using Json = nlohmann::json;
using Protocol = Dialect::Protocol;

struct Form {
  const char* media_type;
  Protocol protocol;
  bool json;
};

constexpr std::array kForms = std::to_array<Form>({
    {"application/json", Protocol::kConnectUnary, true},
    {"application/proto", Protocol::kConnectUnary, false},
    {"application/connect+json", Protocol::kConnectStream, true},
    {"application/connect+proto", Protocol::kConnectStream, false},
    {"application/grpc-web", Protocol::kGrpcWeb, false},
    {"application/grpc-web+proto", Protocol::kGrpcWeb, false},
    {"application/grpc-web+json", Protocol::kGrpcWeb, true},
    {"application/grpc-web-text", Protocol::kGrpcWebText, false},
    {"application/grpc-web-text+proto", Protocol::kGrpcWebText, false},
    {"application/grpc", Protocol::kGrpc, false},
    {"application/grpc+proto", Protocol::kGrpc, false},
});

// The end of a stream as Connect says it.
std::string ConnectEnd(const grpc::Status& status, const Trailers& trailers) {
  Json end = Json::object();
  if (!status.ok()) end["error"] = Json::parse(ErrorJson(status));
  for (const auto& [name, value] : ToHeaders(trailers, "")) end["metadata"][name].push_back(value);
  return end.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::optional<Dialect> DialectOf(const std::string& media_type) {
  const auto* const found = std::ranges::find(kForms, media_type, &Form::media_type);
  if (found == kForms.end()) return std::nullopt;
  return Dialect{found->protocol, found->json, media_type};
}

Headers HeadersOf(const Dialect& dialect) {
  Headers headers = {{"content-type", dialect.content_type}};
  if (dialect.protocol != Protocol::kGrpc) headers.emplace_back("cache-control", "no-store");
  // No message is compressed.
  if (dialect.protocol == Protocol::kConnectUnary)
    headers.emplace_back("accept-encoding", "identity");
  if (dialect.protocol == Protocol::kConnectStream) {
    headers.emplace_back("connect-accept-encoding", "identity");
  }
  if (dialect.grpc()) headers.emplace_back("grpc-accept-encoding", "identity");
  return headers;
}

std::string MessagePrefix(std::size_t size) {
  const auto prefix = FramePrefix(0, size);
  return {prefix.data(), prefix.size()};
}

Headers TrailersOf(const grpc::Status& status, const Trailers& trailers) {
  Headers headers = {{"grpc-status", std::to_string(static_cast<int>(status.error_code()))}};
  if (!status.error_message().empty()) {
    headers.emplace_back("grpc-message", PercentEncode(status.error_message()));
  }
  if (!status.error_details().empty()) {
    headers.emplace_back("grpc-status-details-bin", ToBase64(status.error_details()));
  }
  std::ranges::move(ToHeaders(trailers, ""), std::back_inserter(headers));
  return headers;
}

std::string WebTrailers(const grpc::Status& status, const Trailers& trailers) {
  std::string lines;
  for (const auto& [name, value] : TrailersOf(status, trailers)) {
    lines += fmt::format("{}: {}\r\n", name, value);
  }
  return lines;
}

std::string EndOf(const Dialect& dialect, const grpc::Status& status, const Trailers& trailers) {
  if (dialect.protocol == Protocol::kGrpc) return "";
  if (!dialect.grpc()) return ToBytes({kEndOfStream, ConnectEnd(status, trailers)});
  const std::string end = ToBytes({kTrailers, WebTrailers(status, trailers)});
  return dialect.protocol == Protocol::kGrpcWebText ? ToPaddedBase64(end) : end;
}

HttpAnswer Failure(const Dialect& dialect, const grpc::Status& error, const Trailers& trailers) {
  if (dialect.protocol == Protocol::kGrpc) {
    HttpAnswer answer{200, HeadersOf(dialect)};
    std::ranges::move(TrailersOf(error, trailers), std::back_inserter(answer.headers));
    return answer;
  }
  if (dialect.framed()) return {200, HeadersOf(dialect), EndOf(dialect, error, trailers)};
  HttpAnswer answer{HttpStatus(error.error_code()), HeadersOf(dialect), ErrorJson(error)};
  answer.headers.front().second = "application/json";  // Also if messages are bytes.
  std::ranges::move(ToHeaders(trailers, "trailer-"), std::back_inserter(answer.headers));
  return answer;
}

}  // namespace contact::gateway
