#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "base/file_descriptor.h"
#include "base/mutex.h"
#include "rpc/net/listener.h"
#include "rpc/net/open_connections.h"

namespace contact {

struct ConnectionLimits {
  int in_all = 4096;
  int per_peer = 4096;  ///< Of one address of the network.
  /// A peer whose system takes nothing of what is sent for so long is cut.
  std::chrono::milliseconds stall{30'000};
};

/// As many connections as the process has file descriptors for, some kept for all else; the soft
/// limit on descriptors is raised for them as far as the hard one allows.
ConnectionLimits FitToDescriptors(ConnectionLimits wanted);

/// Accepts connections on a thread of its own and hands them to gRPC. Those past a limit are
/// closed at once. gRPC's own listener would accept nothing ever again once descriptors had run
/// out; this one waits until there are some.
class ConnectionAcceptor {
 public:
  /// Takes a connection over, with its descriptor.
  using HandOver = std::function<void(int listener, int fd)>;

  ConnectionAcceptor(Listener listener, ConnectionLimits limits, HandOver hand_over);
  ~ConnectionAcceptor();
  ConnectionAcceptor(const ConnectionAcceptor&) = delete;
  ConnectionAcceptor& operator=(const ConnectionAcceptor&) = delete;

  /// Stops listening. Idempotent; by one thread.
  void Close();
  /// Cuts the connections that are open. gRPC closes none with a write under way, and the write to
  /// a peer that reads nothing never ends.
  void Cut();

  /// Connections that are open now.
  std::size_t open() const;
  /// Connections that were closed at once.
  std::int64_t refused() const { return refused_; }

 private:
  void Loop();
  int PollTime() const;
  void CutStalled();
  bool Accept(int listener);
  bool Admit(int fd, const std::string& peer);
  bool Full(const std::string& peer) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool StoppedWithin(std::chrono::milliseconds time) const;

  Listener listener_;
  const ConnectionLimits limits_;
  const HandOver hand_over_;
  const FileDescriptor stop_;        ///< An eventfd; readable: stop.
  bool out_of_descriptors_ = false;  // Of the thread.
  std::atomic<std::int64_t> refused_ = 0;

  mutable Mutex mutex_;
  mutable OpenConnections connections_ ABSL_GUARDED_BY(mutex_);
  std::chrono::steady_clock::time_point swept_ ABSL_GUARDED_BY(mutex_);
  std::chrono::steady_clock::time_point looked_ ABSL_GUARDED_BY(mutex_);
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
