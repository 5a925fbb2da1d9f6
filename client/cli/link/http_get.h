#pragma once

#include <chrono>
#include <string>

namespace contact::cli {

/// The page at `path` of the HTTP server at `address`, HOST:PORT. Throws Failure: kUnreachable with
/// why it cannot be had, kTimeout.
std::string HttpGet(const std::string& address, const std::string& path,
                    std::chrono::milliseconds timeout);

}  // namespace contact::cli
