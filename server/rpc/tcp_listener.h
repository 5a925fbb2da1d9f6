#pragma once

#include <string>
#include <vector>

#include "storage/file_descriptor.h"

namespace contact {

/// Sockets that listen on every address that a host name stands for, on one port.
struct TcpListener {
  std::vector<FileDescriptor> sockets;  ///< Non-blocking. None: see OpenTcpListener.
  int port = 0;
};

/// Listens on `HOST:PORT`, an IPv6 address in brackets; port 0 is any free one. No sockets if HOST
/// has no address here, or a port is taken: then none of its addresses is used.
TcpListener OpenTcpListener(const std::string& address);

}  // namespace contact
