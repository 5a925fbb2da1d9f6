#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/file_descriptor.h"
#include "gateway/net/open_connections.h"
#include "rpc/net/listener.h"

namespace contact::gateway {

/// Accepts connections. Those past a limit are closed at once; while there is no descriptor for
/// them they wait in the system's queue. Lives on the one thread of its io_context, but for Open
/// and Close. Owned by shared pointers.
class Acceptor : public std::enable_shared_from_this<Acceptor> {
 public:
  /// A connection that was let in.
  struct Accepted {
    FileDescriptor fd;
    /// See UriOf.
    std::string uri;
    OpenConnections::Lease lease;
  };
  /// Takes it over; must not keep the thread.
  using Take = std::function<void(Accepted)>;

  /// Begins to accept.
  static std::shared_ptr<Acceptor> Open(boost::asio::io_context& io, Listener listener,
                                        std::shared_ptr<OpenConnections> connections,
                                        std::chrono::milliseconds stall, Take take);

  /// Stops listening and removes the socket file. Waits for the thread; not to be called on it, and
  /// only once.
  void Close();

 private:
  using Waiting = boost::asio::posix::stream_descriptor;
  Acceptor(boost::asio::io_context& io, Listener listener,
           std::shared_ptr<OpenConnections> connections, std::chrono::milliseconds stall,
           Take take);

  /// Waits for connections to a socket.
  void Await(Waiting& socket);
  /// Accepts what is there. False: there is no descriptor.
  bool AcceptAll(int listener);
  void LetIn(FileDescriptor fd);

  boost::asio::io_context& io_;
  Listener listener_;
  const std::shared_ptr<OpenConnections> connections_;
  const std::chrono::milliseconds stall_;
  const Take take_;
  /// One for each socket of the listener, whose descriptor it has.
  std::vector<std::unique_ptr<Waiting>> waiting_;
  /// Runs while there is no descriptor.
  boost::asio::steady_timer pause_;
  bool out_of_descriptors_ = false;
};

}  // namespace contact::gateway
