#include "gateway/net/socket.h"

#include <openssl/err.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <utility>

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
using asio::generic::stream_protocol;
using ErrorCode = boost::system::error_code;

// OpenSSL counts in int.
constexpr std::size_t kMostOfSsl = 1 << 20;

int FamilyOf(int fd) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  return address.ss_family;
}

}  // namespace

Socket::Socket(asio::io_context& io, FileDescriptor fd, Ssl ssl)
    : handle_(io.get_executor(), stream_protocol(FamilyOf(fd.get()), 0), fd.get()),
      timer_(io.get_executor()),
      ssl_(std::move(ssl)) {
  fd.Release();
}

std::vector<std::string> Socket::names() const {
  return ssl_ ? NamesOf(*ssl_) : std::vector<std::string>();
}

ssize_t Socket::Result(int result) const {
  if (result > 0) return result;
  const int error = SSL_get_error(ssl_.get(), result);
  ERR_clear_error();
  if (error == SSL_ERROR_ZERO_RETURN) return 0;
  errno = error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE ? EAGAIN : EPROTO;
  return -1;
}

ssize_t Socket::Read(void* bytes, std::size_t most) {
  if (!ssl_) return recv(handle_.native_handle(), bytes, most, 0);
  std::size_t size = 0;
  // A record of TLS is up to 16 KiB: more than one is read at a time.
  while (size < most) {
    const auto part = static_cast<int>(std::min(most - size, kMostOfSsl));
    const ssize_t read = Result(SSL_read(ssl_.get(), static_cast<char*>(bytes) + size, part));
    if (read <= 0) return size > 0 ? static_cast<ssize_t>(size) : read;
    size += static_cast<std::size_t>(read);
    if (SSL_pending(ssl_.get()) == 0) break;
  }
  return static_cast<ssize_t>(size);
}

ssize_t Socket::Write(const void* bytes, std::size_t size) {
  if (!ssl_) return send(handle_.native_handle(), bytes, size, MSG_NOSIGNAL);
  return Result(SSL_write(ssl_.get(), bytes, static_cast<int>(std::min(size, kMostOfSsl))));
}

bool Socket::has_buffered() const { return ssl_ && SSL_pending(ssl_.get()) > 0; }

Awaitable<bool> Socket::Wait(WaitType type, Time end) {
  if (end != Time::max()) {
    timer_.expires_at(end);
    timer_.async_wait([weak = weak_from_this()](ErrorCode error) {
      const auto self = weak.lock();
      if (error || !self || self->timer_.expiry() > std::chrono::steady_clock::now()) return;
      self->handle_.cancel(error);
    });
  }
  ErrorCode error;
  co_await handle_.async_wait(type, asio::redirect_error(asio::use_awaitable, error));
  timer_.expires_at(Time::max());
  co_return !error;
}

Awaitable<bool> Socket::Handshake(Time end) {
  if (!ssl_) co_return true;
  for (;;) {
    const int result = SSL_accept(ssl_.get());
    if (result == 1) co_return true;
    const int error = SSL_get_error(ssl_.get(), result);
    ERR_clear_error();
    if (error != SSL_ERROR_WANT_READ && error != SSL_ERROR_WANT_WRITE) co_return false;
    const bool going_on =
        co_await Wait(error == SSL_ERROR_WANT_READ ? Handle::wait_read : Handle::wait_write, end);
    if (!going_on) co_return false;
  }
}

Awaitable<std::size_t> Socket::ReadSome(void* bytes, std::size_t most, Time end) {
  for (;;) {
    const ssize_t size = Read(bytes, most);
    if (size >= 0) co_return static_cast<std::size_t>(size);
    if (errno != EAGAIN) co_return 0;
    const bool going_on = co_await Wait(Handle::wait_read, end);
    if (!going_on) co_return 0;
  }
}

Awaitable<bool> Socket::WriteAll(Parts parts, std::chrono::milliseconds stall, Time end) {
  // Small parts go out together: each write is a call of the system, and a record of TLS.
  constexpr std::size_t kTogether = 16 << 10;
  std::string joined;
  for (std::size_t i = 0; i < parts.size();) {
    std::string_view rest = parts[i++];
    if (rest.size() < kTogether) {
      joined = rest;
      while (i < parts.size() && joined.size() + parts[i].size() <= 2 * kTogether)
        joined += parts[i++];
      rest = joined;
    }
    while (!rest.empty()) {
      const ssize_t size = Write(rest.data(), rest.size());
      if (size > 0) rest.remove_prefix(static_cast<std::size_t>(size));
      if (size > 0) continue;
      if (size < 0 && errno != EAGAIN) co_return false;
      const Time late = std::chrono::steady_clock::now() + stall;
      const bool going_on = co_await Wait(Handle::wait_write, std::min(late, end));
      if (!going_on) co_return false;
    }
  }
  co_return true;
}

Socket::Input Socket::Peek() {
  char byte = 0;
  const ssize_t size = ssl_ ? Result(SSL_peek(ssl_.get(), &byte, 1))
                            : recv(handle_.native_handle(), &byte, 1, MSG_PEEK);
  if (size > 0) return Input::kBytes;
  return size < 0 && errno == EAGAIN ? Input::kNothing : Input::kEnd;
}

void Socket::CloseHalf() {
  ErrorCode ignored;
  handle_.shutdown(stream_protocol::socket::shutdown_send, ignored);
}

void Socket::Close() {
  ErrorCode ignored;
  if (ssl_) SSL_shutdown(ssl_.get());
  ERR_clear_error();
  handle_.shutdown(stream_protocol::socket::shutdown_both, ignored);
}

}  // namespace contact::gateway
