#pragma once

#include <grpcpp/support/status.h>

#include <map>
#include <string>
#include <string_view>

#include "gateway/protocol/http.h"
#include "gateway/protocol/metadata.h"

namespace contact::gateway {

/// How a client speaks: the protocol and the form of the messages.
struct Dialect {
  enum class Protocol {
    kConnectUnary,   ///< The body is the message.
    kConnectStream,  ///< The body is frames, of which the last has the end in JSON.
    kGrpcWeb,        ///< The body is frames, of which the last has the trailers.
    kGrpcWebText,    ///< The same in base64.
    kGrpc,           ///< The body is frames, and HTTP/2 has the trailers.
  };
  Protocol protocol = Protocol::kConnectUnary;
  /// Messages are JSON, else bytes.
  bool json = true;
  /// Of requests and answers.
  std::string content_type = "application/json";

  /// True for the protocols whose answers are frames and whose HTTP status is always 200.
  bool framed() const { return protocol != Protocol::kConnectUnary; }
  /// True for gRPC and gRPC-Web.
  bool grpc() const { return protocol >= Protocol::kGrpcWeb; }
};

/// The dialect of a media type; nothing if there is none with it.
std::optional<Dialect> DialectOf(const std::string& media_type);

/// What a call's answer ends with.
using Trailers = std::multimap<grpc::string_ref, grpc::string_ref>;

/// The headers of every answer in this dialect.
Headers HeadersOf(const Dialect& dialect);

/// What goes before a message of this size; not for kConnectUnary.
std::string MessagePrefix(std::size_t size);

/// The last frame of an answer, or of kGrpcWebText its base64; none for kGrpc. Not for
/// kConnectUnary.
std::string EndOf(const Dialect& dialect, const grpc::Status& status, const Trailers& trailers);

/// The whole answer that says that a call failed.
HttpAnswer Failure(const Dialect& dialect, const grpc::Status& error,
                   const Trailers& trailers = {});

/// What tells of the end of a call in gRPC's protocols.
Headers TrailersOf(const grpc::Status& status, const Trailers& trailers);

/// The same as the text of gRPC-Web, a line each.
std::string WebTrailers(const grpc::Status& status, const Trailers& trailers);

}  // namespace contact::gateway
