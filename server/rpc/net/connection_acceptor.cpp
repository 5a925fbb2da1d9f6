#include "rpc/net/connection_acceptor.h"

#include <arpa/inet.h>
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

// For the store, gRPC's pollers, the log and the metrics.
constexpr rlim_t kOtherDescriptors = 100;
// Between two looks for closed connections while there are too many.
constexpr milliseconds kSweepTime{10};
constexpr milliseconds kDescriptorWait{50};

std::string PeerOf(const sockaddr_storage& address) {
  if (address.ss_family == AF_UNIX) return "unix";
  std::array<char, INET6_ADDRSTRLEN> text = {};
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  const void* number = &v4.sin_addr;
  if (address.ss_family == AF_INET6) number = &v6.sin6_addr;
  inet_ntop(address.ss_family, number, text.data(), text.size());
  return text.data();
}

// What gRPC's own listener would have set; and a limit where gRPC has none: behind a write that
// does not end, its pings are not sent.
void Prepare(int fd, milliseconds stall) {
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  const auto limit = static_cast<unsigned>(stall.count());
  setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &limit, sizeof(limit));
}

bool IsShortage(int error) {
  return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM;
}

}  // namespace

ConnectionLimits FitToDescriptors(ConnectionLimits wanted) {
  rlimit files = {};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return wanted;
  const rlim_t needed = static_cast<rlim_t>(wanted.in_all) + kOtherDescriptors;
  if (files.rlim_cur < needed) {
    files.rlim_cur = std::min(needed, files.rlim_max);
    setrlimit(RLIMIT_NOFILE, &files);
  }
  if (files.rlim_cur >= needed) return wanted;
  const rlim_t others = std::min(kOtherDescriptors, files.rlim_cur / 2);
  const int in_all = static_cast<int>(files.rlim_cur - others);
  spdlog::warn("only {} file descriptors: {} connections instead of {}", files.rlim_cur, in_all,
               wanted.in_all);
  wanted.in_all = in_all;
  wanted.per_peer = std::min(wanted.per_peer, in_all);
  return wanted;
}

ConnectionAcceptor::ConnectionAcceptor(Listener listener, ConnectionLimits limits,
                                       HandOver hand_over)
    : listener_(std::move(listener)),
      limits_(limits),
      hand_over_(std::move(hand_over)),
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

std::size_t ConnectionAcceptor::open() const {
  const MutexLock lock(mutex_);
  connections_.Sweep();
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
    if (ready <= 0) continue;
    for (std::size_t i = 1; i < waiting.size(); ++i) {
      if (waiting[i].revents == 0) continue;
      const bool shortage = !Accept(waiting[i].fd);
      if (shortage && !out_of_descriptors_) spdlog::error("no file descriptor for a connection");
      out_of_descriptors_ = shortage;
      if (shortage && StoppedWithin(kDescriptorWait)) return;
    }
  }
}

// How long to wait for a connection before the others are looked at.
int ConnectionAcceptor::PollTime() const {
  constexpr milliseconds::rep kLooks = 8;  // In the time of a stall.
  if (listener_.file.empty()) return -1;
  return static_cast<int>(std::max<milliseconds::rep>(1, limits_.stall.count() / kLooks));
}

// The system cuts stalled connections of the network, but none of a file.
void ConnectionAcceptor::CutStalled() {
  const auto now = steady_clock::now();
  const MutexLock lock(mutex_);
  if (listener_.file.empty() || now - looked_ < milliseconds(PollTime())) return;
  connections_.CutStalled(now, limits_.stall);
  looked_ = now;
}

// False: there is no descriptor; the connection stays in the system's queue.
bool ConnectionAcceptor::Accept(int listener) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  FileDescriptor connection(accept4(listener, reinterpret_cast<sockaddr*>(&address), &size,
                                    SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!connection.valid()) return !IsShortage(errno);
  if (Admit(connection.get(), PeerOf(address))) {
    Prepare(connection.get(), limits_.stall);
    hand_over_(listener, connection.Release());
  } else {
    ++refused_;
  }
  return true;
}

bool ConnectionAcceptor::Admit(int fd, const std::string& peer) {
  const MutexLock lock(mutex_);
  if (Full(peer) && steady_clock::now() - swept_ >= kSweepTime) {
    connections_.Sweep();
    swept_ = steady_clock::now();
  }
  if (Full(peer)) return false;
  connections_.Add(fd, peer);
  return true;
}

bool ConnectionAcceptor::Full(const std::string& peer) const {
  return connections_.size() >= static_cast<std::size_t>(limits_.in_all) ||
         connections_.CountOf(peer) >= static_cast<std::size_t>(limits_.per_peer);
}

bool ConnectionAcceptor::StoppedWithin(milliseconds time) const {
  pollfd stop = {stop_.get(), POLLIN, 0};
  return poll(&stop, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace contact
