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
  /// `on_state` is called once a state_changed event is added, before the wakers.
  JobLog(std::uint64_t last, bool ended, Wake on_state = {})
      : on_state_(std::move(on_state)), last_(last), ended_(ended) {}

  /// Adds events that are stored now, the first as `first`, the next after the newest one. The
  /// records get their sequences here.
  void Append(std::uint64_t first, std::vector<LogRecord> records);
  void Append(std::uint64_t first, std::vector<v1::Event> events) {
    Append(first, ToRecords(std::move(events)));
  }

  /// Replaces the progress that watchers have not seen yet.
  void SetProgress(v1::Event progress);

  /// Says that no more events will come, because they cannot be stored.
  void Fail();

  /// What a watcher finds after `position`.
  struct Tail {
    enum class Found {
      kEvents,   ///< `events`.
      kNothing,  ///< The waker will be called, once.
      kOlder,    ///< What follows `position` is in the store only.
      kEnd,      ///< The job has ended and all was read.
      kFailed,
    };
    Found found;
    std::uint64_t position = 0;  ///< All that was asked for up to here has been read.
    std::vector<LogRecord> events = {};
  };
  struct Want {
    std::uint64_t position;
    std::uint32_t kinds;  ///< See KindBit.
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

  void Push(LogRecord record, bool ended) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool IsBeforeRing(std::uint64_t position) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Collect(const Want& want, Tail* tail) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Wakers TakeWaiting() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const Wake on_state_;
  mutable Mutex mutex_;
  std::deque<LogRecord> ring_ ABSL_GUARDED_BY(mutex_);  ///< Up to last_, without a hole.
  std::size_t ring_bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  std::uint64_t last_ ABSL_GUARDED_BY(mutex_);
  bool ended_ ABSL_GUARDED_BY(mutex_);
  bool failed_ ABSL_GUARDED_BY(mutex_) = false;
  LogRecord progress_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t progress_count_ ABSL_GUARDED_BY(mutex_) = 0;
  Wakers waiting_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
