#include "rpc/net/open_connections.h"

#include <linux/sockios.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>

namespace contact {
namespace {

// 0: there is no such descriptor.
ino_t InodeOf(int fd) {
  struct stat status = {};
  return fstat(fd, &status) == 0 ? status.st_ino : 0;
}

}  // namespace

void OpenConnections::Add(int fd, const std::string& peer, const std::string& uri) {
  // If gRPC has closed a connection, the system reuses its descriptor.
  sockets_.insert_or_assign(fd,
                            Socket{.inode = InodeOf(fd), .lease = peers_->Enter(peer), .uri = uri});
}

void OpenConnections::ForgetClosed() {
  std::erase_if(sockets_,
                [](const auto& socket) { return InodeOf(socket.first) != socket.second.inode; });
}

void OpenConnections::Cut() {
  ForgetClosed();
  for (const auto& [fd, socket] : sockets_) shutdown(fd, SHUT_RDWR);
}

void OpenConnections::Cut(const std::string& uri) {
  for (const auto& [fd, socket] : sockets_) {
    if (socket.uri == uri && InodeOf(fd) == socket.inode) shutdown(fd, SHUT_RDWR);
  }
}

std::vector<Traffic> OpenConnections::Traffics() const {
  std::vector<Traffic> all;
  for (const auto& [fd, socket] : sockets_) {
    tcp_info info = {};
    socklen_t size = sizeof(info);
    if (InodeOf(fd) != socket.inode) continue;
    if (getsockopt(fd, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) continue;
    all.push_back({socket.uri, info.tcpi_bytes_received, info.tcpi_bytes_acked});
  }
  return all;
}

void OpenConnections::CutStalled(Time now, std::chrono::milliseconds stall) {
  ForgetClosed();
  for (auto& [fd, socket] : sockets_) {
    int waiting = 0;
    ioctl(fd, SIOCOUTQ, &waiting);
    if (waiting == 0 || waiting != socket.waiting) {
      socket.waiting = waiting;
      socket.since = now;
    } else if (now - socket.since >= stall) {
      shutdown(fd, SHUT_RDWR);
    }
  }
}

}  // namespace contact
