#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contact::gateway {

/// Names, in lower case, and values of a head, in their order.
using Headers = std::vector<std::pair<std::string, std::string>>;

/// A request as it came.
struct HttpRequest {
  /// True for HTTP/2, whose answers may have trailers.
  bool http2 = false;
  std::string method = "GET";
  /// As in the first line: path and query.
  std::string target = "/";
  Headers headers = {};
  std::string body = {};

  /// The target up to its query.
  std::string_view path() const;
  /// The first value of a name in lower case; empty if there is none.
  std::string_view header(std::string_view name) const;
  bool has(std::string_view name) const;
};

/// An answer that is there as a whole. Length and connection are not among its headers.
struct HttpAnswer {
  int status = 200;
  Headers headers = {};
  std::string body = {};
  /// What HTTP/2 sends behind the body.
  Headers trailers = {};
};

/// An answer of one line.
HttpAnswer PlainAnswer(int status, std::string line);

/// The value of a name in the query of a target, decoded; nothing if it is not there or is no
/// proper percent-encoding.
std::optional<std::string> QueryValue(std::string_view target, std::string_view name);

/// Undoes percent-encoding, and `+` if `form`; nothing if a `%` has no two digits behind it.
std::optional<std::string> PercentDecode(std::string_view text, bool form);

/// Encodes what is not printable ASCII, and `%`, as gRPC's messages are.
std::string PercentEncode(std::string_view text);

/// The media type of a header's value: without parameters, in lower case.
std::string MediaType(std::string_view value);

/// True if the text may be the value of a header: it has no control characters.
bool IsFieldValue(std::string_view text);

}  // namespace contact::gateway
