#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <memory>
#include <optional>
#include <string>

#include "gateway/call/exchange.h"
#include "gateway/call/service.h"
#include "gateway/net/held_bytes.h"
#include "gateway/net/open_connections.h"

namespace contact::gateway {

/// One HTTP/1.1 connection: requests in, answers out, in time.
class Http1Connection final : public Exchange,
                              public std::enable_shared_from_this<Http1Connection> {
 public:
  /// Serves a connection, of which `first` was read already, until it ends.
  static Awaitable<void> Serve(std::shared_ptr<Service> service, HeldBytes& held,
                               std::shared_ptr<Socket> socket, boost::asio::io_context& io,
                               Peer peer, std::string_view first);

  const Peer& peer() const override { return peer_; }
  Awaitable<bool> Send(const HttpRequest& request, HttpAnswer answer) override;
  Awaitable<bool> SendHead(const HttpRequest& request, HttpAnswer answer) override;
  Awaitable<bool> SendParts(Parts parts) override;
  Awaitable<bool> SendEnd(Headers trailers) override;
  Awaitable<void> Writable() override;
  void Watch(Leaving leaving) override;
  void Unwatch() override;
  bool left() const override { return left_; }

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using ErrorCode = boost::beast::error_code;

  Http1Connection(std::shared_ptr<Service> service, HeldBytes& held, std::shared_ptr<Socket> socket,
                  boost::asio::io_context& io, Peer peer);

  /// Answers the requests.
  Awaitable<void> Run();
  /// The next request. One that cannot be read is refused here. Nothing: the connection is over.
  Awaitable<std::optional<HttpRequest>> Read();
  /// Waits until something of the next request is there. False: nothing comes.
  Awaitable<bool> Begin();
  /// Has the parser read its head, or all.
  Awaitable<ErrorCode> Parse(Parser& parser, bool all, Time end);
  /// Reads the body, if the service has room for it. False: the request was refused.
  Awaitable<bool> ReadBody(Parser& parser, const HttpRequest& head);
  /// Refuses a request that cannot be read, and waits until the client has seen that.
  Awaitable<void> Reject(const Parser& parser, ErrorCode error);
  Awaitable<void> Refuse(const HttpRequest& head, HttpAnswer answer);
  /// Sends all; gives up a client that takes nothing for a while, or has not taken all at `end`.
  Awaitable<bool> Write(Parts parts, Time end = Time::max());
  /// Waits for a sign of leaving, for the Watch of this number.
  void Look(Leaving leaving, int watch);
  /// The head without what says how long the answer is.
  std::string HeadText(const HttpAnswer& answer) const;

  const std::shared_ptr<Service> service_;
  const std::shared_ptr<Socket> socket_;
  const Peer peer_;
  /// Bytes that were read and belong to the next requests.
  boost::beast::flat_buffer buffer_;
  /// Of the request that is being answered.
  bool keep_alive_ = true;
  bool http11_ = true;
  bool left_ = false;
  /// Of one request and one answer.
  HeldBytes::Account account_;
  /// What its body has of the service's memory.
  Memory::Share body_;
  /// Counts Watch, whose ends come late.
  int watch_ = 0;
};

}  // namespace contact::gateway
