#include "gateway/dispatch.h"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <string>
#include <utility>

#include "gateway/http1/connection.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;

// How HTTP/2 begins, and no request of HTTP/1.1 (RFC 9113, 3.4).
constexpr std::string_view kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

bool MayBePreface(std::string_view first) {
  return kPreface.starts_with(first.substr(0, kPreface.size()));
}

// The first bytes, enough to tell the versions apart; none if the client says nothing.
Awaitable<std::string> FirstOf(Socket& socket, Time end) {
  std::string first;
  while (first.size() < kPreface.size() && MayBePreface(first)) {
    std::string part(4096, 0);
    const std::size_t size = co_await socket.ReadSome(part.data(), part.size(), end);
    if (size == 0) co_return "";
    first.append(part, 0, size);
  }
  co_return first;
}

Awaitable<void> Serve(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
                      std::shared_ptr<Socket> socket, Peer peer, OpenConnections::Lease lease) {
  const auto cut =
      service->connections()->Register([&io = thread.io, weak = std::weak_ptr(socket)](bool now) {
        if (!now) return;
        asio::post(io, [weak] {
          if (const auto open = weak.lock()) open->Close();
        });
      });
  const Time end = std::chrono::steady_clock::now() + service->options().handshake;
  const bool shaken = co_await socket->Handshake(end);
  if (!shaken) co_return;
  peer.names = socket->names();
  const std::string first = co_await FirstOf(*socket, end);
  if (first.empty()) co_return;
  if (MayBePreface(first)) {
    Http2Connection::Serve(std::move(service), held, thread, std::move(socket), std::move(peer),
                           std::move(lease), first);
  } else {
    co_await Http1Connection::Serve(std::move(service), held, std::move(socket), thread.io,
                                    std::move(peer), first);
  }
}

}  // namespace

void Dispatch(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
              Acceptor::Accepted connection) {
  asio::post(thread.io, [service = std::move(service), &held, &thread,
                         accepted = std::make_shared<Acceptor::Accepted>(std::move(connection))] {
    const auto& tls = service->options().tls;
    Ssl ssl = tls ? tls->Make(accepted->fd.get()) : nullptr;
    auto socket = std::make_shared<Socket>(thread.io, std::move(accepted->fd), std::move(ssl));
    asio::co_spawn(thread.io,
                   Serve(service, held, thread, std::move(socket), Peer{std::move(accepted->uri)},
                         std::move(accepted->lease)),
                   [](const std::exception_ptr& error) {
                     if (error) spdlog::error("a connection of the gateway failed");
                   });
  });
}

}  // namespace contact::gateway
