#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/link/client.h"

namespace contact::cli {

/// Asks the server for a copy of its store and writes it to `path`, which is replaced only by a
/// copy that is whole, checked and on disk. Returns its size in bytes. Throws Failure.
std::int64_t ReceiveBackup(Client& client, const std::string& path,
                           std::optional<std::chrono::steady_clock::time_point> deadline);

}  // namespace contact::cli
