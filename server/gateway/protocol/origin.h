#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// Whom the gateway answers. A page of the web may reach a port of this machine, by its address or
/// by a name that its owner lets lead here; both show in the request.
struct OriginRules {
  /// Names that `Host` may have beside those of the loopback; without port.
  std::vector<std::string> hosts = {};
  /// Origins that may read answers beside pages of the gateway itself, such as
  /// `https://lab.example:8443`.
  std::vector<std::string> origins = {};
};

/// Why the request is not answered; nothing if it is. `Host` must be of the loopback or one of the
/// rules, whatever its port; `Origin`, if there is one, the gateway's own or one of the rules.
std::optional<HttpAnswer> Refuse(const OriginRules& rules, const HttpRequest& request);

/// The headers that let a page of an origin of the rules read the answer; none for others.
Headers CorsHeaders(const OriginRules& rules, const HttpRequest& request);

/// The answer to OPTIONS where these methods are allowed.
HttpAnswer Options(const OriginRules& rules, const HttpRequest& request,
                   const std::string& allowed);

}  // namespace contact::gateway
