#include "gateway/net/memory.h"

namespace contact::gateway {
namespace {

constexpr std::size_t kSmall = 64 << 10;

}  // namespace

Memory::Share Memory::Take(std::size_t bytes) {
  if (bytes <= kSmall) bytes = 0;
  Share share(this, {bytes});
  if (taken_.fetch_add(bytes) + bytes > most_) share.reset();
  return share;
}

}  // namespace contact::gateway
