#pragma once

#include <cstdint>
#include <filesystem>

namespace contact {

/// Bytes of memory that this process may take: those of the machine, or fewer if one of its control
/// groups has a limit. `groups` says which these are, `root` is where the system shows them.
std::int64_t MemoryLimit(const std::filesystem::path& groups = "/proc/self/cgroup",
                         const std::filesystem::path& root = "/sys/fs/cgroup");

}  // namespace contact
