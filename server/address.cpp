#include "address.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace contact {

std::optional<Address> ParseAddress(const std::string& text) {
  if (text.starts_with("unix:")) return std::nullopt;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const std::string host = text.substr(0, colon);
  const std::string port = text.substr(colon + 1);
  const bool bracketed = host.front() == '[' && host.back() == ']';
  if (!bracketed && host.find(':') != std::string::npos) return std::nullopt;
  if (port.empty() || port.size() > 5 || !std::ranges::all_of(port, ::isdigit)) return std::nullopt;
  if (std::stoi(port) > 65535) return std::nullopt;
  return Address{host, std::stoi(port)};
}

bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "[::1]") return true;
  const auto numeric = [](char c) { return c == '.' || (c >= '0' && c <= '9'); };
  return host.starts_with("127.") && std::ranges::all_of(host, numeric);
}

}  // namespace contact
