#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "gateway/outgoing.h"
#include "gateway/service.h"

namespace contact::gateway {

/// One HTTP/1.1 connection: requests in, answers out, in time. Used on the one thread of its
/// io_context. The coroutines are those of one user, who awaits each before the next.
class Connection {
 public:
  template <class T>
  using Awaitable = boost::asio::awaitable<T>;
  using Executor = boost::asio::io_context::executor_type;

  /// Takes over `fd`. The service outlives it.
  Connection(boost::asio::io_context& io, Service& service, int fd);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Executor executor() { return stream_.get_executor(); }
  /// The client, as gRPC calls it.
  const std::string& peer() const { return peer_; }

  /// The next request. One that cannot be read is refused here. Nothing: the connection is over.
  Awaitable<std::optional<HttpRequest>> Read();

  // Each of these is false if the client takes nothing more.

  /// Sends a whole answer; or that there is no memory for it, as the request's protocol says it.
  Awaitable<bool> Send(const HttpRequest& request, HttpAnswer answer);
  /// Sends an answer in pieces: its head, then any number of parts, then its end.
  Awaitable<bool> SendHead(const HttpRequest& request, HttpAnswer answer);
  Awaitable<bool> SendParts(Parts parts);
  Awaitable<bool> SendEnd();

  /// Waits until the client's system takes bytes, or the connection is cut.
  Awaitable<void> Writable();

  /// What a client does that leaves. TCP tells who closes the whole connection from who closes the
  /// half of it only once something is sent.
  enum class Leaving {
    kCloses,  ///< The connection or its half of it.
    kResets,  ///< It takes nothing more.
  };
  /// Calls `left` once if the client leaves so before Unwatch. `left` keeps this alive.
  void Watch(Leaving leaving, std::function<void()> left);
  void Unwatch();

  /// Ends the connection.
  void Close();

 private:
  using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol, Executor>;
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Time = std::chrono::steady_clock::time_point;

  /// Waits until something of the next request is there. False: nothing comes.
  Awaitable<bool> Begin();
  /// Reads the body, if the service has room for it. False: the request was refused.
  Awaitable<bool> ReadBody(Parser& parser, const HttpRequest& head);
  /// True if the client has closed the connection or its half of it.
  bool Closed();
  /// Refuses a request that cannot be read, and waits until the client has seen that.
  Awaitable<void> Reject(const Parser& parser, boost::beast::error_code error);
  Awaitable<void> Refuse(const HttpRequest& head, HttpAnswer answer);
  /// Sends all; gives up a client that takes nothing for a while, or has not taken all at `end`.
  Awaitable<bool> Write(Parts parts, Time end = Time::max());
  /// The head without what says how long the answer is.
  std::string HeadText(const HttpAnswer& answer) const;

  Service& service_;
  const std::string peer_;
  Stream stream_;
  /// Bytes that were read and belong to the next requests.
  boost::beast::flat_buffer buffer_;
  /// Of the request that is being answered.
  bool keep_alive_ = true;
  bool http11_ = true;
  /// What its body has of the service's memory.
  Memory::Share body_;
};

}  // namespace contact::gateway
