#include "rpc/net/open_connections.h"

#include <linux/sockios.h>
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

void OpenConnections::Add(int fd, const std::string& peer) {
  if (const auto before = sockets_.find(fd); before != sockets_.end()) {
    Leave(before->second.peer);  // gRPC closed it, and the system reused the descriptor.
  }
  sockets_.insert_or_assign(fd, Socket{.inode = InodeOf(fd), .peer = peer});
  ++peers_[peer];
}

void OpenConnections::ForgetClosed() {
  std::erase_if(sockets_, [this](const auto& socket) {
    if (InodeOf(socket.first) == socket.second.inode) return false;
    Leave(socket.second.peer);
    return true;
  });
}

void OpenConnections::Cut() {
  ForgetClosed();
  for (const auto& [fd, socket] : sockets_) shutdown(fd, SHUT_RDWR);
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

std::size_t OpenConnections::CountOf(const std::string& peer) const {
  const auto found = peers_.find(peer);
  return found == peers_.end() ? 0 : found->second;
}

void OpenConnections::Leave(const std::string& peer) {
  const auto found = peers_.find(peer);
  if (--found->second == 0) peers_.erase(found);
}

}  // namespace contact
