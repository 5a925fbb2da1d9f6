#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <set>
#include <stop_token>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "rpc/metrics/stream_metrics.h"

namespace contact {

/// A stream as the loop sees it. Thread-safe; whoever calls it holds a reference to it.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Looks whether the stream's source has something to send.
  virtual void Poke() = 0;
  /// Ends the stream with SERVER_DRAINING, after the message under way.
  virtual void Drain() = 0;
  /// Does what is due at `now`: drops a reader that stalls, sends what time alone brings. True if
  /// the reader has held up a write for over a second.
  virtual bool Tick(std::chrono::steady_clock::time_point now) = 0;
};

/// The one thread that steps all streams from outside gRPC: when a source has grown, when a
/// bookmark is due, when a write has stalled. Thread-safe.
class StreamLoop {
 public:
  /// A reader that takes nothing for `write_stall` is dropped; the loop looks at every stream four
  /// times in that time, and at least every 500 ms. `clock` outlives the loop.
  StreamLoop(const Clock& clock, std::chrono::milliseconds write_stall);

  /// From now on the stream is ticked until it is destroyed, and drained with the others.
  void Add(const std::shared_ptr<Stream>& stream);

  /// Pokes the stream soon, on the loop's thread. Takes a short lock only, so it may be called
  /// under other locks; it takes a weak pointer, so it never destroys a stream there.
  void Wake(const std::weak_ptr<Stream>& stream);

  /// Drains every stream that there is and every one that is added later.
  void Drain();

  /// Ends the thread. To be called before the last reference goes, by another thread. Idempotent.
  void Stop();

  /// Number of streams that are alive.
  std::size_t streams() const;

  /// The counters of all streams.
  const std::shared_ptr<StreamMetrics>& metrics() const { return metrics_; }
  /// The clock of all streams.
  const Clock& clock() const { return clock_; }
  /// Time that a write may take before its reader is dropped.
  std::chrono::milliseconds write_stall() const { return write_stall_; }

 private:
  using Streams = std::set<std::weak_ptr<Stream>, std::owner_less<>>;

  /// Body of the thread.
  void Run(const std::stop_token& stop);
  /// Waits until a stream was woken, `end` has come or `stop` is requested. Returns the streams
  /// that were woken.
  Streams Await(const std::stop_token& stop, std::chrono::steady_clock::time_point end);
  /// Ticks all streams and counts the slow ones.
  void Tick(std::chrono::steady_clock::time_point now);
  /// The streams that have not been destroyed; forgets the others.
  std::vector<std::shared_ptr<Stream>> Alive();

  const Clock& clock_;
  const std::chrono::milliseconds write_stall_;
  const std::shared_ptr<StreamMetrics> metrics_ = std::make_shared<StreamMetrics>();
  mutable Mutex mutex_;
  /// Notified when a stream was woken where none was.
  std::condition_variable_any changed_;
  /// The streams that are ticked. May hold streams that are gone.
  Streams streams_ ABSL_GUARDED_BY(mutex_);
  /// The streams to be poked.
  Streams woken_ ABSL_GUARDED_BY(mutex_);
  /// True once Drain was called.
  bool draining_ ABSL_GUARDED_BY(mutex_) = false;
  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
