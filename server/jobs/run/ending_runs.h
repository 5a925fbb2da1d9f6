#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <stop_token>

#include "base/mutex.h"

namespace contact {

class LogWriter;

/// Runs that have ended and whose last events are on their way to the disk: their workers need not
/// wait for that, so many short jobs share a commit. Thread-safe.
class EndingRuns {
 public:
  /// Keeps the writer of a run, which takes so many bytes of memory, until it is removed.
  void Add(std::shared_ptr<LogWriter> writer, std::size_t bytes);
  /// Forgets a writer, if it is there.
  void Remove(const LogWriter* writer);

  /// Waits while they take too much memory or the store has no space for one, or until `stop` is
  /// requested: so a worker runs ahead of the disk by a few MiB, or some hundred jobs.
  void AwaitRoom(const std::stop_token& stop);

  /// Tries again to store what there was no space for. To be called now and then.
  void Retry();

 private:
  /// A writer, and the bytes that it takes.
  struct Ending {
    std::shared_ptr<LogWriter> writer;
    std::size_t bytes;
  };

  /// True if the store has no space for some writer.
  bool OutOfSpace() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  Mutex mutex_;
  /// Notified when a writer was removed.
  std::condition_variable_any removed_;
  std::map<const LogWriter*, Ending> endings_ ABSL_GUARDED_BY(mutex_);
  /// Of all writers.
  std::size_t bytes_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace contact
