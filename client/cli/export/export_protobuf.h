#pragma once

#include <cstdint>
#include <string>

#include "cli/link/client.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// Waits for the end of a job and writes it to a file as messages of the contract, each after its
/// length as a varint: the Job as GetJob gives it, then every Event as WatchJob gives it, but no
/// bookmarks. Returns how many events. Throws CallFailure, and Failure: kTimeout and kInterrupted
/// when the wait ends first, kLocal if the file cannot be written.
std::int64_t WriteProtobuf(Client& client, const std::string& job, const Settings& settings,
                           const std::string& path);

}  // namespace contact::cli
