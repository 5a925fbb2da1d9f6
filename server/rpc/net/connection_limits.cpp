#include "rpc/net/connection_limits.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>

namespace contact {
namespace {

// File descriptors kept for the store, the pollers of gRPC and Asio, the log and the metrics.
constexpr rlim_t kOtherDescriptors = 100;

// Raises the soft limit on descriptors to `needed`, at most to the hard limit. Returns the limit.
rlim_t RaiseDescriptors(rlim_t needed) {
  rlimit files = {};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return needed;
  if (files.rlim_cur < needed) {
    files.rlim_cur = std::min(needed, files.rlim_max);
    setrlimit(RLIMIT_NOFILE, &files);
  }
  return files.rlim_cur;
}

}  // namespace

ConnectionLimits FitToDescriptors(ConnectionLimits wanted) {
  const rlim_t needed = static_cast<rlim_t>(wanted.in_all) + kOtherDescriptors;
  const rlim_t have = RaiseDescriptors(needed);
  if (have >= needed) return wanted;
  const rlim_t others = std::min(kOtherDescriptors, have / 2);
  const int in_all = static_cast<int>(have - others);
  spdlog::warn("only {} file descriptors: {} connections instead of {}", have, in_all,
               wanted.in_all);
  wanted.in_all = in_all;
  wanted.per_peer = std::min(wanted.per_peer, in_all);
  return wanted;
}

}  // namespace contact
