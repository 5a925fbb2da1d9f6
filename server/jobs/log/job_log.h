#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "contact/v1/event.pb.h"
#include "jobs/job/callback.h"
#include "jobs/log/log_cursor.h"

namespace contact {

/// What is in memory of the log of a job: the newest events that are stored, how far the run is,
/// and who waits for more. Older events are in the store. Thread-safe.
class JobLog {
 public:
  /// `last` is the sequence of the newest stored event; `ended`: it tells of a final state.
  /// `on_state` is called once a state_changed event is added, before the wakers; `on_end` when the
  /// final state is stored, before anybody can see it here.
  JobLog(std::uint64_t last, bool ended, Wake on_state = {}, Wake on_end = {})
      : on_state_(std::move(on_state)), on_end_(std::move(on_end)), last_(last), ended_(ended) {}

  /// Adds events that are stored now, the first as `first`, the next after the newest one. The
  /// records get their sequences here.
  void Append(std::uint64_t first, std::vector<LogRecord> records);
  void Append(std::uint64_t first, std::vector<v1::Event> events) {
    Append(first, ToRecords(std::move(events)));
  }

  /// Of a log that holds no events: the newest stored one is `last`, or a newer one that is known
  /// already; `ended`: as in the constructor.
  void Advance(std::uint64_t last, bool ended);

  /// Replaces the progress that watchers have not seen yet.
  void SetProgress(v1::Event progress);

  /// Says that no more events will come, because they cannot be stored.
  void Fail();

  /// What a watcher finds after `position`.
  struct Tail {
    enum class Found {
      /// There are events.
      kEvents,
      /// There is nothing now. The waker will be called, once.
      kNothing,
      /// What follows `position` is in the store only.
      kOlder,
      /// The job has ended and all of its log was read.
      kEnd,
      /// No more events will come, because they cannot be stored.
      kFailed,
    };
    /// What is there.
    Found found;
    /// All that was asked for up to here has been read.
    std::uint64_t position = 0;
    std::vector<LogRecord> events = {};
  };
  /// What a watcher asks for.
  struct Want {
    /// It has read all events up to this sequence.
    std::uint64_t position;
    /// Kinds of events, see KindBit.
    std::uint32_t kinds;
    /// Bytes of events, about; at least one event is given.
    std::size_t max_bytes;
  };
  /// `progress_seen` counts the progress that the watcher has seen; it starts at 0.
  Tail After(const Want& want, std::uint64_t* progress_seen, std::shared_ptr<const Wake> waker);

  /// True if what follows `position` is in the store only.
  bool IsOlder(std::uint64_t position) const;

  /// Takes back a waker. It may still be called once if that has begun.
  void Forget(const std::shared_ptr<const Wake>& waker);

 private:
  using Wakers = std::set<std::shared_ptr<const Wake>>;

  /// Adds an event to the ring, and drops old ones that have no room. `ended`: see ended_.
  void Push(LogRecord record, bool ended) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// As IsOlder.
  bool IsBeforeRing(std::uint64_t position) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Adds the events in the ring after `want.position` to the tail.
  void Collect(const Want& want, Tail* tail) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Calls `change` under the lock, then, without it, on_state_ if `change` has returned true, and
  /// those who wait.
  template <class Change>
  void Tell(Change change);

  const Wake on_state_;
  const Wake on_end_;
  mutable Mutex mutex_;
  /// The newest events, up to last_, without a hole.
  std::deque<LogRecord> ring_ ABSL_GUARDED_BY(mutex_);
  /// Bytes of the events in ring_.
  std::size_t ring_bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Sequence of the newest stored event.
  std::uint64_t last_ ABSL_GUARDED_BY(mutex_);
  /// True once the newest event tells of a final state.
  bool ended_ ABSL_GUARDED_BY(mutex_);
  /// True once Fail was called.
  bool failed_ ABSL_GUARDED_BY(mutex_) = false;
  /// The newest progress.
  LogRecord progress_ ABSL_GUARDED_BY(mutex_);
  /// Number of calls of SetProgress.
  std::uint64_t progress_count_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Watchers that have found nothing.
  Wakers waiting_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
