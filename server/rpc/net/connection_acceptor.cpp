#include "rpc/net/connection_acceptor.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>
#include <vector>

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// File descriptors kept for the store, gRPC's pollers, the log and the metrics.
constexpr rlim_t kOtherDescriptors = 100;
// Time between two searches for closed connections while there are too many.
constexpr milliseconds kForgetInterval{10};
// Time between two looks at the traffic in ms, and connections that make it longer by one.
constexpr int kLeastLookTime = 20;
constexpr int kConnectionsPerMs = 20;
// There are looks for so long after the last connection was closed.
constexpr milliseconds kAfterTime{2000};
// Bytes of a connection that the system keeps until gRPC reads them. It reads all of them at once
// and accepts their calls only then: of a flood, thousands. It reads what is there after a cut,
// too.
constexpr int kReceiveBuffer = 64 << 10;
// Time to wait after the process has run out of descriptors.
constexpr milliseconds kDescriptorWait{50};

// Sets TCP_NODELAY, as gRPC's own listener does, the size of the receive buffer, and a limit on the
// time that sent bytes may stay unacknowledged: gRPC has none, because it sends no pings while a
// write is under way.
void Prepare(int fd, milliseconds stall) {
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof(kReceiveBuffer));
  const auto limit = static_cast<unsigned>(stall.count());
  setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &limit, sizeof(limit));
}

bool IsShortage(int error) {
  return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM;
}

// Raises the soft limit on descriptors to `needed`, at most to the hard limit. Returns the limit.
rlim_t RaiseDescriptors(rlim_t needed) {
  rlimit files = {};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return needed;
  if (files.rlim_cur < needed) {
    files.rlim_cur = std::min(needed, files.rlim_max);
    setrlimit(RLIMIT_NOFILE, &files);
  }
  return files.rlim_cur;
}

}  // namespace

ConnectionLimits FitToDescriptors(ConnectionLimits wanted) {
  const rlim_t needed = static_cast<rlim_t>(wanted.in_all) + kOtherDescriptors;
  const rlim_t have = RaiseDescriptors(needed);
  if (have >= needed) return wanted;
  const rlim_t others = std::min(kOtherDescriptors, have / 2);
  const int in_all = static_cast<int>(have - others);
  spdlog::warn("only {} file descriptors: {} connections instead of {}", have, in_all,
               wanted.in_all);
  wanted.in_all = in_all;
  wanted.per_peer = std::min(wanted.per_peer, in_all);
  return wanted;
}

ConnectionAcceptor::ConnectionAcceptor(Listener listener, ConnectionLimits limits,
                                       HandOver hand_over, Look look)
    : listener_(std::move(listener)),
      limits_(limits),
      hand_over_(std::move(hand_over)),
      look_(std::move(look)),
      stop_(eventfd(0, EFD_CLOEXEC)),
      thread_([this] { Loop(); }) {}

ConnectionAcceptor::~ConnectionAcceptor() { Close(); }

void ConnectionAcceptor::Close() {
  if (!thread_.joinable()) return;
  eventfd_write(stop_.get(), 1);
  thread_.join();
  listener_.sockets.clear();
  if (!listener_.file.empty()) unlink(listener_.file.c_str());
}

void ConnectionAcceptor::Cut() {
  const MutexLock lock(mutex_);
  connections_.Cut();
}

void ConnectionAcceptor::Cut(const std::string& uri) {
  const MutexLock lock(mutex_);
  connections_.Cut(uri);
}

std::size_t ConnectionAcceptor::open() const {
  const MutexLock lock(mutex_);
  connections_.ForgetClosed();
  return connections_.size();
}

void ConnectionAcceptor::Loop() {
  pthread_setname_np(pthread_self(), "acceptor");
  std::vector<pollfd> waiting = {{stop_.get(), POLLIN, 0}};
  for (const auto& socket : listener_.sockets) waiting.push_back({socket.get(), POLLIN, 0});
  for (;;) {
    const int ready = poll(waiting.data(), waiting.size(), PollTime());
    if (waiting.front().revents != 0) return;
    CutStalled();
    TellTraffic();
    for (std::size_t i = 1; ready > 0 && i < waiting.size(); ++i) {
      if (waiting[i].revents != 0 && !AcceptOrWait(waiting[i].fd)) return;
    }
  }
}

bool ConnectionAcceptor::AcceptOrWait(int listener) {
  const bool shortage = !Accept(listener);
  if (shortage && !out_of_descriptors_) spdlog::error("no file descriptor for a connection");
  out_of_descriptors_ = shortage;
  return !shortage || !StoppedWithin(kDescriptorWait);
}

int ConnectionAcceptor::PollTime() const {
  constexpr milliseconds::rep kLooks = 8;  // In the time of a stall.
  if (!listener_.file.empty()) {
    return static_cast<int>(std::max<milliseconds::rep>(1, limits_.stall.count() / kLooks));
  }
  const MutexLock lock(mutex_);
  const bool some = connections_.size() > 0 || steady_clock::now() - seen_ < kAfterTime;
  if (!look_ || !some) return -1;
  // Looking at all of them takes a few percent of the time.
  return std::max(kLeastLookTime, static_cast<int>(connections_.size()) / kConnectionsPerMs);
}

void ConnectionAcceptor::TellTraffic() {
  const auto now = steady_clock::now();
  const int time = PollTime();
  std::vector<Traffic> all;
  {
    const MutexLock lock(mutex_);
    if (!listener_.file.empty() || time < 0 || now - looked_ < milliseconds(time)) return;
    looked_ = now;
    if (connections_.size() > 0) seen_ = now;
    connections_.ForgetClosed();
    all = connections_.Traffics();
  }
  look_(all, now);
}

void ConnectionAcceptor::CutStalled() {
  if (listener_.file.empty()) return;
  const auto now = steady_clock::now();
  const int time = PollTime();
  const MutexLock lock(mutex_);
  if (now - looked_ < milliseconds(time)) return;
  connections_.CutStalled(now, limits_.stall);
  looked_ = now;
}

bool ConnectionAcceptor::Accept(int listener) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  FileDescriptor connection(accept4(listener, reinterpret_cast<sockaddr*>(&address), &size,
                                    SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!connection.valid()) return !IsShortage(errno);
  if (Admit(connection.get(), AddressOf(address), UriOf(address))) {
    Prepare(connection.get(), limits_.stall);
    hand_over_(listener, connection.Release());
  } else {
    ++refused_;
  }
  return true;
}

bool ConnectionAcceptor::Admit(int fd, const std::string& peer, const std::string& uri) {
  const MutexLock lock(mutex_);
  if (Full(peer) && steady_clock::now() - forgot_ >= kForgetInterval) {
    connections_.ForgetClosed();
    forgot_ = steady_clock::now();
  }
  if (Full(peer)) return false;
  connections_.Add(fd, peer, uri);
  return true;
}

bool ConnectionAcceptor::Full(const std::string& peer) const {
  return connections_.size() >= static_cast<std::size_t>(limits_.in_all) ||
         connections_.CountOf(peer) >= limits_.per_peer;
}

bool ConnectionAcceptor::StoppedWithin(milliseconds time) const {
  pollfd stop = {stop_.get(), POLLIN, 0};
  return poll(&stop, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace contact
