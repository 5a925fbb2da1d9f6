#include "gateway/net/acceptor.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <cerrno>
#include <future>
#include <utility>

#include "rpc/net/peer.h"

namespace contact::gateway {
namespace {

using ErrorCode = boost::system::error_code;

// Time to wait after the process has run out of descriptors.
constexpr std::chrono::milliseconds kDescriptorWait{50};
// Connections that are accepted before other work of the thread has its turn.
constexpr int kAtOnce = 64;

// A packet does not wait for the answer to the one before, and sent bytes stay unacknowledged for a
// limited time.
void Prepare(int fd, std::chrono::milliseconds stall) {
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  const auto limit = static_cast<unsigned>(stall.count());
  setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &limit, sizeof(limit));
}

bool IsShortage(int error) {
  return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM;
}

}  // namespace

Acceptor::Acceptor(boost::asio::io_context& io, Listener listener,
                   std::shared_ptr<OpenConnections> connections, std::chrono::milliseconds stall,
                   Take take)
    : io_(io),
      listener_(std::move(listener)),
      connections_(std::move(connections)),
      stall_(stall),
      take_(std::move(take)),
      pause_(io) {
  for (FileDescriptor& socket : listener_.sockets) {
    waiting_.push_back(std::make_unique<Waiting>(io, socket.Release()));
  }
}

std::shared_ptr<Acceptor> Acceptor::Open(boost::asio::io_context& io, Listener listener,
                                         std::shared_ptr<OpenConnections> connections,
                                         std::chrono::milliseconds stall, Take take) {
  std::shared_ptr<Acceptor> acceptor(
      new Acceptor(io, std::move(listener), std::move(connections), stall, std::move(take)));
  boost::asio::post(io, [acceptor] {
    for (const auto& socket : acceptor->waiting_) acceptor->Await(*socket);
  });
  return acceptor;
}

void Acceptor::Close() {
  std::promise<void> closed;
  boost::asio::post(io_, [this, &closed] {
    waiting_.clear();
    pause_.cancel();
    closed.set_value();
  });
  closed.get_future().wait();
  if (!listener_.file.empty()) unlink(listener_.file.c_str());
}

void Acceptor::Await(Waiting& socket) {
  socket.async_wait(Waiting::wait_read, [self = shared_from_this(), &socket](ErrorCode error) {
    if (error || self->waiting_.empty()) return;
    const bool shortage = !self->AcceptAll(socket.native_handle());
    if (shortage && !self->out_of_descriptors_)
      spdlog::error("no file descriptor for a connection");
    self->out_of_descriptors_ = shortage;
    if (!shortage) return self->Await(socket);
    self->pause_.expires_after(kDescriptorWait);
    self->pause_.async_wait([self, &socket](ErrorCode /*any*/) {
      if (!self->waiting_.empty()) self->Await(socket);
    });
  });
}

bool Acceptor::AcceptAll(int listener) {
  for (int i = 0; i < kAtOnce; ++i) {
    FileDescriptor fd(accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!fd.valid()) return !IsShortage(errno);
    LetIn(std::move(fd));
  }
  return true;
}

void Acceptor::LetIn(FileDescriptor fd) {
  std::string uri = UriOf(fd.get());
  auto lease = connections_->Enter(PeerOf(uri));
  if (!lease) return;
  Prepare(fd.get(), stall_);
  take_({std::move(fd), std::move(uri), std::move(lease)});
}

}  // namespace contact::gateway
