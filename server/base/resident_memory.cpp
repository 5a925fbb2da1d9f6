#include "base/resident_memory.h"

#include <unistd.h>

#include <fstream>

namespace contact {

std::int64_t ResidentMemory() {
  std::int64_t all = 0, resident = 0;  // Pages.
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace contact
