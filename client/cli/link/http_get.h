#pragma once

#include <chrono>
#include <string>

namespace contact::cli {

/// The page at `path`, of at most 64 MiB, of the HTTP server at `address`, HOST:PORT. `timeout`
/// limits connecting and each wait for data. Throws Failure: kTimeout, or kUnreachable with the
/// reason if there is no connection or another answer than status 200.
std::string HttpGet(const std::string& address, const std::string& path,
                    std::chrono::milliseconds timeout);

}  // namespace contact::cli
