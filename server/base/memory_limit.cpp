#include "base/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace contact {
namespace {

namespace fs = std::filesystem;

// The least limit that `file` has in the folder and those above it, up to `root`. In a container
// the folder itself may not be there; its limit is then that of the root.
std::int64_t Least(std::int64_t limit, const fs::path& root, fs::path folder, const char* file) {
  for (;; folder = folder.parent_path()) {
    std::int64_t bytes = 0;
    if (std::ifstream(root / folder / file) >> bytes && bytes > 0) limit = std::min(limit, bytes);
    if (folder.empty()) return limit;
  }
}

}  // namespace

std::int64_t MemoryLimit(const fs::path& groups, const fs::path& root) {
  std::int64_t limit = sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
  std::ifstream lines(groups);
  // A line is NUMBER:CONTROLLERS:/FOLDER, of which the slash is ignored here; version 2 of control
  // groups has no controllers there.
  for (std::string number, controllers, folder; std::getline(lines, number, ':') &&
                                                std::getline(lines, controllers, ':') &&
                                                std::getline(lines.ignore(), folder);) {
    if (controllers.empty()) limit = Least(limit, root, folder, "memory.max");
    if (("," + controllers + ",").find(",memory,") == std::string::npos) continue;
    limit = Least(limit, root / "memory", folder, "memory.limit_in_bytes");
  }
  return limit;
}

}  // namespace contact
