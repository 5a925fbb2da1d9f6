#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "rpc/metrics/stream_metrics.h"

namespace contact {

/// A stream as the loop sees it.
class Stream {
 public:
  virtual ~Stream() = default;
  virtual void Poke() = 0;
  virtual void Drain() = 0;
  /// Sees to what time brings. True if the reader is slow.
  virtual bool Tick(std::chrono::steady_clock::time_point now) = 0;
};

/// The one thread that steps all streams from outside gRPC: when their source has grown, when a
/// bookmark is due, when a write has stalled. Thread-safe.
class WatchLoop {
 public:
  /// Looks at every watcher once a `tick`.
  explicit WatchLoop(std::chrono::milliseconds tick);

  /// From now on the watcher is ticked, until it is destroyed, and drained with the others.
  void Add(const std::shared_ptr<Stream>& watcher);

  /// Pokes the watcher soon. Takes a short lock only, so it may be called under other locks;
  /// taking a weak pointer, it never destroys a watcher there.
  void Wake(const std::weak_ptr<Stream>& watcher);

  /// Drains every watcher, now and to come.
  void Drain();

  /// Ends the thread. Call it before the last reference goes, from another thread.
  void Stop();

  /// Watchers that are alive.
  std::size_t watchers() const;

  /// Where the streams count, for their part.
  const std::shared_ptr<StreamMetrics>& metrics() const { return metrics_; }

 private:
  using Watchers = std::set<std::weak_ptr<Stream>, std::owner_less<>>;

  void Run();
  void Tick(std::chrono::steady_clock::time_point now);
  std::vector<std::shared_ptr<Stream>> Alive();

  const std::chrono::milliseconds tick_;
  const std::shared_ptr<StreamMetrics> metrics_ = std::make_shared<StreamMetrics>();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Watchers watchers_;      // Guarded by mutex_.
  Watchers woken_;         // Guarded by mutex_.
  bool draining_ = false;  // Guarded by mutex_.
  bool stopped_ = false;   // Guarded by mutex_.
  std::thread thread_;     // Last: it uses all of the above.
};

}  // namespace contact
