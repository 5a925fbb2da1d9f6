#pragma once

#include <string>
#include <vector>

#include "base/file_descriptor.h"

namespace contact {

/// Sockets that listen on every address that a host name stands for, on one port; or on one file.
struct Listener {
  std::vector<FileDescriptor> sockets;  ///< Non-blocking. None: see below.
  int port = 0;                         ///< 0: of a file.
  std::string file = {};                ///< To be removed at the end; empty: none.
};

/// Listens on `HOST:PORT`, an IPv6 address in brackets; port 0 is any free one. No sockets if HOST
/// has no address here, or a port is taken: then none of its addresses is used.
Listener OpenTcpListener(const std::string& address);

/// Listens on a socket file that its owner and group may use; takes the place of one that nobody
/// serves any more. No sockets if another process serves it, or it cannot be made.
Listener OpenFileListener(const std::string& path);

}  // namespace contact
