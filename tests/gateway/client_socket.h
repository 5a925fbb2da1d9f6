#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <stdexcept>

#include "base/file_descriptor.h"
#include "testing/await.h"

namespace contact {

/// A connection to 127.0.0.1 that says nothing.
class ClientSocket {
 public:
  ClientSocket() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  explicit ClientSocket(int port) : ClientSocket() { Connect(port); }

  /// `from` is an address of the loopback network.
  void Connect(int port, const char* from = "127.0.0.1") {
    const sockaddr_in source = Address(from, 0);
    const sockaddr_in target = Address("127.0.0.1", port);
    if (bind(socket_.get(), reinterpret_cast<const sockaddr*>(&source), sizeof(source)) != 0 ||
        connect(socket_.get(), reinterpret_cast<const sockaddr*>(&target), sizeof(target)) != 0) {
      throw std::runtime_error("cannot connect");
    }
  }

  /// Waits for the end of the connection. False: it does not come.
  bool IsClosedByPeer(std::chrono::milliseconds limit = kPatience) const {
    char byte = 0;
    for (const auto end = std::chrono::steady_clock::now() + limit;
         std::chrono::steady_clock::now() < end;) {
      pollfd readable = {socket_.get(), POLLIN, 0};
      if (poll(&readable, 1, static_cast<int>(limit.count())) <= 0) return false;
      if (recv(socket_.get(), &byte, 1, 0) <= 0) return true;  // Not what gRPC says first.
    }
    return false;
  }

  void Close() { socket_ = FileDescriptor(); }

 private:
  static sockaddr_in Address(const char* host, int port) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(port));
    inet_pton(AF_INET, host, &address.sin_addr);
    return address;
  }

  FileDescriptor socket_;
};

}  // namespace contact
