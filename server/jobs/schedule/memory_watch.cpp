#include "jobs/schedule/memory_watch.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace contact {

MemoryWatch::MemoryWatch(std::function<std::int64_t()> resident, std::int64_t most)
    : resident_(std::move(resident)), most_(most) {}

bool MemoryWatch::Look() {
  const std::int64_t limit = crowded_ ? most_ / 10 * 9 : most_;
  const bool crowded = most_ > 0 && resident_() > limit;
  if (std::exchange(crowded_, crowded) == crowded) return crowded_;
  if (crowded) {
    spdlog::warn("more than {} bytes of memory are taken; no run begins beside another", most_);
  } else {
    spdlog::info("there is memory for runs again");
  }
  return crowded_;
}

}  // namespace contact
