#include "jobs/quota/message_bytes.h"

#include <algorithm>

namespace contact {
namespace {

// A message is not worth to be larger, and not to be smaller.
constexpr std::size_t kMostBytes = std::size_t{256} * 1024;
constexpr std::size_t kLeastBytes = std::size_t{8} * 1024;
// Of the messages of all readers, as long as none is smaller than the least.
constexpr std::size_t kAllBytes = std::size_t{24} << 20;

}  // namespace

std::size_t MessageBytes(int readers) {
  return std::clamp(kAllBytes / static_cast<std::size_t>(std::max(readers, 1)), kLeastBytes,
                    kMostBytes);
}

}  // namespace contact
