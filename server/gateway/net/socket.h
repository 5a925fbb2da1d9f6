#pragma once

#include <sys/types.h>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_descriptor.h"
#include "gateway/net/tls_context.h"

namespace contact::gateway {

template <class T>
using Awaitable = boost::asio::awaitable<T>;
using Executor = boost::asio::io_context::executor_type;
using Time = std::chrono::steady_clock::time_point;

/// Bytes that go out one after the other, and belong to somebody else.
using Parts = std::vector<std::string_view>;

/// One connection as bytes, in TLS or not. OpenSSL works on the descriptor itself, so that a
/// connection has no buffers of its own. Used on the one thread of its io_context; the coroutines
/// are those of one user, who awaits each before the next. Owned by shared pointers.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  using Handle = boost::asio::basic_stream_socket<boost::asio::generic::stream_protocol, Executor>;
  using WaitType = Handle::wait_type;

  /// Takes over `fd`, which does not block. `ssl`: null for plain bytes.
  Socket(boost::asio::io_context& io, FileDescriptor fd, Ssl ssl);

  Executor executor() { return handle_.get_executor(); }
  Handle& handle() { return handle_; }
  /// The names in the client's certificate.
  std::vector<std::string> names() const;

  /// As recv and send: a number of bytes; 0 at the end; negative with errno, EAGAIN if there is
  /// nothing to do now.
  ssize_t Read(void* bytes, std::size_t most);
  ssize_t Write(const void* bytes, std::size_t size);
  /// True if bytes wait within TLS, of which the system knows nothing.
  bool has_buffered() const;

  // Each gives up at `end`.

  /// Makes the handshake of TLS, if there is one. False: it failed.
  Awaitable<bool> Handshake(Time end);
  /// Waits until the socket is so. False: it is over.
  Awaitable<bool> Wait(WaitType type, Time end);
  /// Reads what is there, once there is something; 0: nothing comes any more.
  Awaitable<std::size_t> ReadSome(void* bytes, std::size_t most, Time end);
  /// Writes all; gives up also once nothing was taken for `stall`.
  Awaitable<bool> WriteAll(Parts parts, std::chrono::milliseconds stall, Time end);

  /// What there is to read: bytes, nothing yet, or the end of the client's half.
  enum class Input { kBytes, kNothing, kEnd };
  Input Peek();

  /// Ends what goes out, or all.
  void CloseHalf();
  void Close();

 private:
  /// The result of an operation of OpenSSL as recv and send tell it.
  ssize_t Result(int result) const;

  Handle handle_;
  boost::asio::basic_waitable_timer<std::chrono::steady_clock,
                                    boost::asio::wait_traits<std::chrono::steady_clock>, Executor>
      timer_;
  Ssl ssl_;
};

}  // namespace contact::gateway
