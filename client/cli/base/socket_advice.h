#pragma once

#include <string>

namespace contact::cli {

/// What helps a user whose call does not reach the server at a socket file, by the words of the
/// system in `words`; empty if nothing is known, such as for an address of the network.
std::string SocketAdvice(const std::string& server, const std::string& words);

}  // namespace contact::cli
