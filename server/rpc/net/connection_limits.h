#pragma once

namespace contact {

/// How many connections may be open.
struct ConnectionLimits {
  int in_all = 4096;
  /// From one address of the network, or of one user of a socket file.
  int per_peer = 4096;
};

/// Raises the process's soft limit on file descriptors as far as `wanted` needs and the hard limit
/// allows, and returns `wanted`, reduced to what the descriptors suffice for, with some kept for
/// the store and the log. Logs a warning if it reduces.
ConnectionLimits FitToDescriptors(ConnectionLimits wanted);

}  // namespace contact
