#include "rpc/net/peer.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <atomic>

namespace contact {
namespace {

// A number of its own for each connection to a socket file: the system has none.
std::string UriOfFile(int fd) {
  static std::atomic<std::uint64_t> connections = 0;
  ucred user = {};
  socklen_t size = sizeof(user);
  if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &user, &size) != 0) user.uid = static_cast<uid_t>(-1);
  return fmt::format("unix:{}:{}", user.uid, ++connections);
}

}  // namespace

std::string PeerOf(const std::string& uri) { return uri.substr(0, uri.rfind(':')); }

std::string UriOf(int fd) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  getpeername(fd, reinterpret_cast<sockaddr*>(&address), &size);
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  std::array<char, INET6_ADDRSTRLEN> text = {};
  if (address.ss_family == AF_INET) {
    inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size());
    return fmt::format("ipv4:{}:{}", text.data(), ntohs(v4.sin_port));
  }
  if (address.ss_family != AF_INET6) return UriOfFile(fd);
  inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size());
  return fmt::format("ipv6:%5B{}%5D:{}", text.data(), ntohs(v6.sin6_port));
}

std::string CallerUri(const grpc::ServerContextBase& context) {
  const auto named = context.client_metadata().find(kPeerHeader);
  if (named == context.client_metadata().end()) return context.peer();
  return {named->second.data(), named->second.size()};
}

PeerCounts::Lease PeerCounts::Enter(const std::string& peer) {
  {
    const MutexLock lock(mutex_);
    ++open_[peer];
  }
  return {this, [self = shared_from_this(), peer](const void*) { self->Leave(peer); }};
}

int PeerCounts::Of(const std::string& peer) const {
  const MutexLock lock(mutex_);
  const auto found = open_.find(peer);
  return found == open_.end() ? 0 : found->second;
}

void PeerCounts::Leave(const std::string& peer) {
  const MutexLock lock(mutex_);
  const auto found = open_.find(peer);
  if (--found->second == 0) open_.erase(found);
}

}  // namespace contact
