#include "rpc/net/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace contact {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses Resolve(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos) return {nullptr, &freeaddrinfo};
  std::string host = address.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), address.c_str() + colon + 1, &hints, &found) != 0) found = nullptr;
  return {found, &freeaddrinfo};
}

void SetPort(int port, sockaddr_storage* address) {
  const auto number = htons(static_cast<in_port_t>(port));
  if (address->ss_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(address)->sin6_port = number;
  } else {
    reinterpret_cast<sockaddr_in*>(address)->sin_port = number;
  }
}

int PortOf(int socket) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.ss_family == AF_INET6
                   ? reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port
                   : reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

// Listens on one address; sets errno if it cannot.
FileDescriptor Listen(const addrinfo& info, int port) {
  FileDescriptor socket(::socket(info.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.valid()) return socket;
  // Without it a restart waits for connections in TIME_WAIT. It does not allow two listeners.
  const int on = 1;
  setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_storage address = {};
  std::memcpy(&address, info.ai_addr, info.ai_addrlen);
  if (port != 0) SetPort(port, &address);
  if (bind(socket.get(), reinterpret_cast<sockaddr*>(&address), info.ai_addrlen) != 0 ||
      listen(socket.get(), SOMAXCONN) != 0) {
    return FileDescriptor();
  }
  return socket;
}

// `localhost` may have an IPv6 address on a machine without IPv6.
bool MayMiss(int error) { return error == EADDRNOTAVAIL || error == EAFNOSUPPORT; }

// Nothing if the path is empty or too long.
std::optional<sockaddr_un> FileAddress(const std::string& path) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) return std::nullopt;
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

FileDescriptor FileSocket() {
  return FileDescriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

bool IsServed(const sockaddr_un& address) {
  const FileDescriptor socket = FileSocket();
  return connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 ||
         errno == EAGAIN;
}

// Removes the socket file that a killed server has left, and no other kind of file.
void RemoveSocket(const std::string& path) {
  struct stat status = {};
  if (lstat(path.c_str(), &status) == 0 && S_ISSOCK(status.st_mode)) unlink(path.c_str());
}

}  // namespace

Listener OpenListener(const std::string& address) {
  constexpr std::string_view kUnix = "unix:";
  return address.starts_with(kUnix) ? OpenFileListener(address.substr(kUnix.size()))
                                    : OpenTcpListener(address);
}

Listener OpenTcpListener(const std::string& address) {
  Listener listener;
  const Addresses addresses = Resolve(address);
  for (const addrinfo* info = addresses.get(); info != nullptr; info = info->ai_next) {
    FileDescriptor socket = Listen(*info, listener.port);
    if (!socket.valid()) {
      if (MayMiss(errno)) continue;
      return {};
    }
    listener.port = PortOf(socket.get());
    listener.sockets.push_back(std::move(socket));
  }
  return listener;
}

Listener OpenFileListener(const std::string& path) {
  const auto address = FileAddress(path);
  if (!address || IsServed(*address)) return {};
  RemoveSocket(path);
  FileDescriptor socket = FileSocket();
  if (bind(socket.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof(*address)) != 0) {
    return {};
  }
  constexpr mode_t kOwnerAndGroup = 0660;
  Listener listener{.sockets = {}, .file = path};
  if (chmod(path.c_str(), kOwnerAndGroup) != 0 || listen(socket.get(), SOMAXCONN) != 0) return {};
  listener.sockets.push_back(std::move(socket));
  return listener;
}

}  // namespace contact
