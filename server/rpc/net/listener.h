#pragma once

#include <string>
#include <vector>

#include "base/file_descriptor.h"

namespace contact {

/// Sockets that listen on one port at every address of a host name, or on one socket file.
struct Listener {
  /// Non-blocking sockets. Empty: the address cannot be had.
  std::vector<FileDescriptor> sockets;
  /// The port of all sockets; 0 for a socket file.
  int port = 0;
  /// Socket file to remove at the end; empty: none.
  std::string file = {};
};

/// Listens on `HOST:PORT` or `unix:PATH`, see below.
Listener OpenListener(const std::string& address);

/// Listens on `HOST:PORT`, an IPv6 address in brackets; port 0 is any free one. Returns no sockets
/// if HOST has no address here or the port is taken at one of its addresses.
Listener OpenTcpListener(const std::string& address);

/// Listens on a socket file that its owner and group may use, and replaces one that no process
/// serves any more. Returns no sockets if another process serves it or it cannot be made.
Listener OpenFileListener(const std::string& path);

}  // namespace contact
