#include "address.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace contact {

std::optional<std::string> HostOf(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (address.starts_with("unix:") || colon == std::string::npos || colon == 0) return std::nullopt;
  const std::string host = address.substr(0, colon);
  const std::string port = address.substr(colon + 1);
  const bool bracketed = host.front() == '[' && host.back() == ']';
  if (!bracketed && host.find(':') != std::string::npos) return std::nullopt;
  if (port.empty() || port.size() > 5 || !std::ranges::all_of(port, ::isdigit)) return std::nullopt;
  if (std::stoi(port) > 65535) return std::nullopt;
  return host;
}

bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "[::1]") return true;
  const auto numeric = [](char c) { return c == '.' || (c >= '0' && c <= '9'); };
  return host.starts_with("127.") && std::ranges::all_of(host, numeric);
}

}  // namespace contact
