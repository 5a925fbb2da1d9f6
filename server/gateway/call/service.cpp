#include "gateway/call/service.h"

#include <algorithm>
#include <iterator>

#include "gateway/openapi/openapi.h"
#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {
namespace {

// Pages load nothing but what the gateway serves. Plots draw into images and blobs.
constexpr char kPolicy[] =
    "default-src 'self'; img-src 'self' data: blob:; worker-src 'self' blob:; object-src 'none'; "
    "base-uri 'self'; form-action 'self'; frame-ancestors 'none'";

bool Has(const Headers& headers, std::string_view name) {
  return std::ranges::any_of(headers, [name](const auto& entry) { return entry.first == name; });
}

}  // namespace

HttpAnswer Service::Answer(const HttpRequest& request) const {
  const std::string allowed = AllowedMethods(request);
  if (request.method == "OPTIONS") return Options(options_.rules, request, allowed);
  if (request.method != "GET" && request.method != "HEAD") {
    HttpAnswer answer =
        PlainAnswer(request.method == "POST" ? 404 : 405, "there is no such method");
    answer.headers.emplace_back("allow", allowed);
    return answer;
  }
  if (request.path() == "/healthz") return PlainAnswer(200, "ok");
  if (request.path() == "/v1/openapi.json") {
    return {200, {{"content-type", "application/json"}}, std::string(OpenApiDocument())};
  }
  if (request.path() != "/metrics") return File(request);
  if (!options_.metrics) {
    return PlainAnswer(403, "metrics are at --metrics-listen where callers are asked who they are");
  }
  return {200, {{"content-type", "text/plain; version=0.0.4; charset=utf-8"}}, options_.metrics()};
}

HttpAnswer Service::File(const HttpRequest& request) const {
  constexpr std::string_view kDocs = "/docs";
  const std::string_view path = request.path();
  if (path == kDocs) return {308, {{"location", "/docs/"}}, ""};
  if (!path.starts_with("/docs/")) return dashboard_.Get(DashboardFile(path), request);
  return docs_.Get(DocsFile(path.substr(kDocs.size())), request);
}

// A page cannot ask in gRPC's own protocol without an Origin, and clients call a server whatever
// name they have for it.
std::optional<HttpAnswer> Service::Refusal(const HttpRequest& request) const {
  if (IsNative(request) && !request.has("origin")) return std::nullopt;
  return Refuse(options_.rules, request);
}

HttpAnswer Service::Complete(const HttpRequest& request, HttpAnswer answer) const {
  if (IsNative(request)) return answer;
  Headers& headers = answer.headers;
  if (!Has(headers, "cache-control")) headers.emplace_back("cache-control", "no-store");
  headers.emplace_back("content-security-policy", kPolicy);
  headers.emplace_back("x-content-type-options", "nosniff");
  headers.emplace_back("referrer-policy", "no-referrer");
  const Headers cors = CorsHeaders(options_.rules, request);
  if (cors.empty()) headers.emplace_back("cross-origin-resource-policy", "same-origin");
  std::ranges::copy(cors, std::back_inserter(headers));
  return answer;
}

}  // namespace contact::gateway
