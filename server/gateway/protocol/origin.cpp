#include "gateway/protocol/origin.h"

#include <absl/strings/ascii.h>
#include <arpa/inet.h>

#include <algorithm>

namespace contact::gateway {
namespace {

bool Has(const std::vector<std::string>& all, std::string_view one) {
  return std::ranges::find(all, one) != all.end();
}

// The host of `Host`, in lower case and without port, an IPv6 address with its brackets.
std::string HostIn(std::string_view value) {
  std::string text = absl::AsciiStrToLower({value.data(), value.size()});
  const std::size_t bracket = text.starts_with('[') ? text.find(']') : 0;
  if (bracket == std::string::npos) return "";
  const std::size_t colon = text.find(':', bracket);
  const auto port = text.substr(std::min(colon, text.size()));
  const bool number = port.size() > 1 && port.size() <= 6 &&
                      std::all_of(port.begin() + 1, port.end(), absl::ascii_isdigit);
  if (!port.empty() && !number) return "";
  return text.substr(0, colon);
}

bool IsLoopbackName(const std::string& host) {
  in_addr address = {};
  if (host == "localhost" || host == "[::1]") return true;
  return inet_pton(AF_INET, host.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24U == 127;
}

bool IsAllowedOrigin(const OriginRules& rules, const HttpRequest& request) {
  return request.has("origin") && Has(rules.origins, request.header("origin"));
}

bool IsOwnOrigin(const HttpRequest& request) {
  const std::string host(request.header("host"));
  const std::string_view origin = request.header("origin");
  return origin == "http://" + host || origin == "https://" + host;
}

}  // namespace

std::optional<HttpAnswer> Refuse(const OriginRules& rules, const HttpRequest& request) {
  if (std::ranges::count(request.headers, "host", &Headers::value_type::first) > 1) {
    return PlainAnswer(400, "a request has one Host");  // RFC 9112, 3.2.
  }
  const std::string host = HostIn(request.header("host"));
  if (!IsLoopbackName(host) && !Has(rules.hosts, host)) {
    return PlainAnswer(421, "Host is not a name of this server; see --http-host");
  }
  if (request.has("origin") && !IsOwnOrigin(request) && !IsAllowedOrigin(rules, request)) {
    return PlainAnswer(403, "pages of this origin are not answered; see --http-allow-origin");
  }
  return std::nullopt;
}

Headers CorsHeaders(const OriginRules& rules, const HttpRequest& request) {
  if (!IsAllowedOrigin(rules, request)) return {};
  return {{"access-control-allow-origin", std::string(request.header("origin"))},
          {"access-control-expose-headers",
           "grpc-status, grpc-message, grpc-status-details-bin, connect-accept-encoding"},
          {"vary", "origin"}};
}

HttpAnswer Options(const OriginRules& rules, const HttpRequest& request,
                   const std::string& allowed) {
  HttpAnswer answer{204, {{"allow", allowed}}, ""};
  if (!IsAllowedOrigin(rules, request)) return answer;
  answer.headers.emplace_back("access-control-allow-methods", "GET, POST");
  const std::string asked(request.header("access-control-request-headers"));
  if (!asked.empty()) answer.headers.emplace_back("access-control-allow-headers", asked);
  answer.headers.emplace_back("access-control-max-age", "7200");
  return answer;
}

}  // namespace contact::gateway
