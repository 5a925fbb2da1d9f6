#include "rpc/net/peer.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <array>

namespace contact {
namespace {

// What gRPC says of a call that comes by no connection. Connections have an address.
constexpr char kWithin[] = "unknown";

}  // namespace

std::string PeerOf(const std::string& uri) {
  const bool has_port = uri.starts_with("ipv4:") || uri.starts_with("ipv6:");
  return uri.substr(0, has_port ? uri.rfind(':') : uri.find(':'));
}

std::string AddressOf(const sockaddr_storage& address) {
  if (address.ss_family == AF_UNIX) return "unix";
  std::array<char, INET6_ADDRSTRLEN> text = {};
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  const void* number = &v4.sin_addr;
  if (address.ss_family == AF_INET6) number = &v6.sin6_addr;
  inet_ntop(address.ss_family, number, text.data(), text.size());
  return text.data();
}

std::string UriOf(const sockaddr_storage& address) {
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  if (address.ss_family == AF_INET) {
    return fmt::format("ipv4:{}:{}", AddressOf(address), ntohs(v4.sin_port));
  }
  if (address.ss_family != AF_INET6) return "unix:";
  return fmt::format("ipv6:%5B{}%5D:{}", AddressOf(address), ntohs(v6.sin6_port));
}

std::string CallerUri(const grpc::ServerContextBase& context) {
  std::string transport = context.peer();
  if (transport != kWithin) return transport;
  const auto named = context.client_metadata().find(kPeerHeader);
  if (named == context.client_metadata().end()) return transport;
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
