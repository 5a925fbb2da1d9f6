#pragma once

#include <optional>
#include <string>

namespace contact {

/// The host of the address `HOST:PORT`, where PORT is a number up to 65535: a name or an IPv4
/// address, or an IPv6 address with its brackets. Nothing for any other text, and for `unix:PATH`.
std::optional<std::string> HostOf(const std::string& address);

/// True if only this machine can reach the host: `localhost` or a numeric loopback address. Other
/// names are not, because a name such as 127.evil.example may lead anywhere.
bool IsLoopback(const std::string& host);

}  // namespace contact
