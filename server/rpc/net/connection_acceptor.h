#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "base/file_descriptor.h"
#include "base/mutex.h"
#include "rpc/net/listener.h"
#include "rpc/net/open_connections.h"

namespace contact {

/// Limits of connections.
struct ConnectionLimits {
  /// Connections that are open.
  int in_all = 4096;
  /// Connections that are open from one address of the network.
  int per_peer = 4096;
  /// A connection whose peer's system takes none of the sent bytes for this time is cut.
  std::chrono::milliseconds stall{30'000};
};

/// Raises the process's soft limit on file descriptors as far as `wanted` needs and the hard limit
/// allows, and returns `wanted`, reduced to what the descriptors suffice for, with some kept for
/// the store and the log. Logs a warning if it reduces.
ConnectionLimits FitToDescriptors(ConnectionLimits wanted);

/// Accepts connections on a thread of its own and hands them to gRPC. Those past a limit are closed
/// at once. gRPC 1.51's own listener would never accept again once descriptors had run out; this
/// one waits until there are some. Thread-safe but for Close.
class ConnectionAcceptor {
 public:
  /// Takes over the connection `fd`, accepted by the socket `listener`. Called on the acceptor's
  /// thread, which it must not keep: that cuts those who flood.
  using HandOver = std::function<void(int listener, int fd)>;

  /// Is told the traffic of all open connections of the network, many times a second. Called on the
  /// acceptor's thread; may call Cut.
  using Look = std::function<void(const std::vector<Traffic>& all,
                                  std::chrono::steady_clock::time_point now)>;

  /// Starts to accept.
  ConnectionAcceptor(Listener listener, ConnectionLimits limits, HandOver hand_over,
                     Look look = {});
  ~ConnectionAcceptor();
  ConnectionAcceptor(const ConnectionAcceptor&) = delete;
  ConnectionAcceptor& operator=(const ConnectionAcceptor&) = delete;

  /// Stops listening and removes the socket file. Idempotent; to be called by one thread.
  void Close();

  /// Cuts the connections that are open. gRPC closes none with a write under way, and a write to a
  /// peer that reads nothing never ends.
  void Cut();
  /// Cuts the connection with this `ServerContext::peer()`, if it is open.
  void Cut(const std::string& uri);

  /// Number of connections that are open now.
  std::size_t open() const;
  /// Number of connections that were closed at once, since the start.
  std::int64_t refused() const { return refused_; }

 private:
  /// Body of the thread.
  void Loop();
  /// Time in ms that poll waits before connections are looked at; -1: any time.
  int PollTime() const;
  /// Tells look_ the traffic if it is time.
  void TellTraffic();
  /// Cuts stalled connections of a socket file. Those of the network are cut by the system.
  void CutStalled();
  /// Accepts a connection; waits a moment if there is no descriptor for it. False: stopped.
  bool AcceptOrWait(int listener);
  /// Accepts a connection, or refuses it. False if there is no descriptor for it: it then stays in
  /// the system's queue.
  bool Accept(int listener);
  /// Adds the connection to connections_. False: there are too many.
  bool Admit(int fd, const std::string& peer, const std::string& uri);
  /// True if no more connection of the peer may be open.
  bool Full(const std::string& peer) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Waits for `time`. True: Close was called.
  bool StoppedWithin(std::chrono::milliseconds time) const;

  Listener listener_;
  const ConnectionLimits limits_;
  /// Gives connections to gRPC.
  const HandOver hand_over_;
  const Look look_;
  /// An eventfd; readable once Close was called.
  const FileDescriptor stop_;
  /// True while there is no descriptor for a connection. Only for the thread.
  bool out_of_descriptors_ = false;
  /// Connections that were closed at once.
  std::atomic<std::int64_t> refused_ = 0;

  mutable Mutex mutex_;
  /// Mutable, because counting forgets those that gRPC has closed.
  mutable OpenConnections connections_ ABSL_GUARDED_BY(mutex_);
  /// Time of the last ForgetClosed.
  std::chrono::steady_clock::time_point forgot_ ABSL_GUARDED_BY(mutex_);
  /// When TellTraffic last found a connection.
  std::chrono::steady_clock::time_point seen_ ABSL_GUARDED_BY(mutex_);
  /// Time of the last CutStalled or TellTraffic.
  std::chrono::steady_clock::time_point looked_ ABSL_GUARDED_BY(mutex_);
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
