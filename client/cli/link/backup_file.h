#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/link/client.h"

namespace contact::cli {

/// Asks the server for a copy of its store and writes it to `path`. The file there is replaced only
/// by a copy that is whole, has the server's checksums, passes SQLite's check and is on disk. The
/// call ends at `deadline`, if there is one. Returns the size in bytes. Throws CallFailure for the
/// call, Failure for a damaged copy (kRunFailed) and for the file (kLocal).
std::int64_t ReceiveBackup(Client& client, const std::string& path,
                           std::optional<std::chrono::steady_clock::time_point> deadline);

}  // namespace contact::cli
