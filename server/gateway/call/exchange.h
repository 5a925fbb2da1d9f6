#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gateway/net/socket.h"
#include "gateway/protocol/http.h"

namespace contact::gateway {

/// Who asks: what the gateway tells the server of a connection.
struct Peer {
  /// See UriOf.
  std::string uri;
  /// The names in its certificate, see NamesOf.
  std::vector<std::string> names = {};
};

/// A request and the way of its answer, whatever version of HTTP carries them. Used on the one
/// thread of its io_context; the coroutines are those of one user, who awaits each before the next.
/// Owned by shared pointers.
class Exchange {
 public:
  explicit Exchange(boost::asio::io_context& io) : io_(io), changed_(io) {
    changed_.expires_at(Time::max());
  }
  virtual ~Exchange() = default;
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  boost::asio::io_context& io() const { return io_; }
  virtual const Peer& peer() const = 0;

  // Each of these is false if the client takes nothing more.

  /// Sends a whole answer; or that there is no memory for it, as the request's protocol says it.
  virtual Awaitable<bool> Send(const HttpRequest& request, HttpAnswer answer) = 0;
  /// Sends an answer in pieces: its head, then any number of parts, then its end.
  virtual Awaitable<bool> SendHead(const HttpRequest& request, HttpAnswer answer) = 0;
  virtual Awaitable<bool> SendParts(Parts parts) = 0;
  virtual Awaitable<bool> SendEnd(Headers trailers) = 0;

  /// Waits until the client takes bytes, or has left.
  virtual Awaitable<void> Writable() = 0;

  /// What a client does that leaves. TCP tells who closes the whole connection from who closes the
  /// half of it only once something is sent.
  enum class Leaving {
    kCloses,  ///< The connection or its half of it.
    kResets,  ///< It takes nothing more.
  };
  /// From now on until Unwatch, a client that leaves so makes `left` true and wakes.
  virtual void Watch(Leaving leaving) = 0;
  virtual void Unwatch() = 0;
  virtual bool left() const = 0;

  /// The next message of a request that IsNative and whose body still comes: its bytes, or nothing
  /// until Wake.
  virtual std::optional<grpc::ByteBuffer> NextMessage() { return std::nullopt; }
  /// True once no message comes any more.
  virtual bool at_end() const { return true; }

  /// Waits for Wake. What is awaited is looked at before and after: there is no wake that is not
  /// heard, because nothing else runs between a look and the wait.
  Awaitable<void> Changed() {
    boost::system::error_code ignored;
    co_await changed_.async_wait(boost::asio::redirect_error(boost::asio::use_awaitable, ignored));
  }
  void Wake() { changed_.cancel(); }

 private:
  boost::asio::io_context& io_;
  /// Cancelled when something has changed.
  boost::asio::steady_timer changed_;
};

}  // namespace contact::gateway
