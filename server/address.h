#pragma once

#include <optional>
#include <string>

namespace contact {

/// An address of the network to listen on.
struct Address {
  std::string host;  ///< A name or an IPv4 address; an IPv6 address has its brackets.
  int port;          ///< 0 to 65535.
};

/// Reads `HOST:PORT`. Nothing for any other text, and for `unix:PATH`.
std::optional<Address> ParseAddress(const std::string& text);

/// True if only this machine can reach the host: `localhost` or a numeric loopback address. Other
/// names are not, because a name such as 127.evil.example may lead anywhere.
bool IsLoopback(const std::string& host);

}  // namespace contact
