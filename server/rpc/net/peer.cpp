#include "rpc/net/peer.h"

namespace contact {

std::string PeerOf(const std::string& uri) {
  const bool has_port = uri.starts_with("ipv4:") || uri.starts_with("ipv6:");
  return uri.substr(0, has_port ? uri.rfind(':') : uri.find(':'));
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
