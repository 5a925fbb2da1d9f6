#pragma once

#include <string>

namespace contact::cli {

/// What helps a user who cannot reach the server at a socket file; empty if nothing is known, such
/// as for an address of the network. `words`: the error of the connection, with the system's
/// reason.
std::string SocketAdvice(const std::string& server, const std::string& words);

}  // namespace contact::cli
