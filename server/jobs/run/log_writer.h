#pragma once

#include <absl/status/statusor.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "jobs/log/job_log.h"
#include "jobs/run/run_control.h"
#include "storage/records.h"

namespace contact {

class Clock;
class Store;
struct JobChange;

/// Writes what happens to a job while one worker has it: to the store in batches, and once they
/// are committed to the job's log in memory.
///
/// Runs ahead of the disk by a few MiB at most, then makes the worker wait. While the store is
/// full it waits too, and tries again until there is space or the server stops. If events cannot
/// be stored at all it stops the run. Calls belong to the worker's thread, up to Finish: after it
/// the worker is free, and the writer goes on by itself on the store's thread.
class LogWriter : public std::enable_shared_from_this<LogWriter> {
 public:
  /// The log that the writer appends to.
  struct Place {
    /// Of the job.
    std::string name;
    /// The stored epoch of the job before this writer takes it.
    std::uint64_t epoch;
    /// The log in memory. Never null while events are added.
    std::shared_ptr<JobLog> log;
  };
  /// Must be owned by a shared_ptr. Store and clock outlive the writer. The writer stops `run` when
  /// nothing can be stored any more, and stores nothing once the run was given up. It stops waiting
  /// for space when `shutdown` is requested.
  LogWriter(Store& store, const Clock& clock, Place place, std::shared_ptr<RunControl> run,
            std::stop_token shutdown);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Takes the job over: stores it with these events and a new epoch. Does not wait.
  void Take(v1::Job job, std::vector<v1::Event> events);

  /// False: it was not taken, because the run has spent its budget or was given up.
  bool Add(v1::Event event);
  /// Stores a state from which the run can be resumed, together with the events added before it.
  /// Starts to write at once if no batch is being written.
  void AddCheckpoint(std::string state);
  /// Starts to write the pending events if they are old enough. To be called now and then while the
  /// run adds no events.
  void WriteIfDue();

  /// Bytes of memory, about, of the events that were not handed to the store yet.
  std::size_t pending_bytes() const { return pending_.bytes; }

  /// True while a batch found no space in the store and is to be tried again.
  bool out_of_space() const {
    const MutexLock lock(mutex_);
    return disk_ == Disk::kFull;
  }

  /// Called with the job once it is on disk with all its events and the log has them; with null if
  /// it cannot be stored. On the store's thread, or in Finish if the store had failed before.
  using Ended = std::function<void(const v1::Job*)>;
  /// Stores the job with the last event, after all that was added. Does not wait; until `ended` is
  /// called the run is held. False: it was given up, and `ended` is not called.
  bool Finish(v1::Job job, v1::Event event, Ended ended);
  /// Tries again what there was no space for, if it is time. To be called now and then after
  /// Finish, on any thread.
  void Retry();

 private:
  enum class Disk {
    /// Nothing is being written.
    kIdle,
    /// batch_ belongs to the store's thread.
    kWriting,
    /// batch_ is to be tried again.
    kFull,
    /// Nothing can be stored any more.
    kLost,
  };
  /// What one operation of the store writes.
  struct Batch {
    /// The events to store. Empty once the batch is encoded.
    std::vector<v1::Event> events;
    /// Bytes of memory that the batch takes, about.
    std::size_t bytes = 0;
    /// True: raises the epoch of the job.
    bool take = false;
    /// True once a write of the batch has failed.
    bool failed = false;
    /// The job in its new state, if it has one.
    std::optional<v1::Job> job;
    /// A state to resume from, if there is one.
    std::optional<Checkpoint> checkpoint;
    /// To be called once the batch is stored; empty if it is not the last.
    Ended ended;
    /// Null until the batch is complete.
    std::shared_ptr<const JobChange> encoded;
    /// The encoded events, for the log in memory.
    std::vector<LogRecord> records;
  };
  using Time = std::chrono::steady_clock::time_point;

  /// Starts to write the pending events if they are many or old, and waits if they are too many.
  void WriteDueBatch();
  /// Serialises and compresses a complete batch. Costly, so not for the store's thread.
  void Encode(Batch* batch) const;
  /// Starts to write the next batch, or the last one again, if it is time. Never waits.
  void Advance(Time now);
  /// Puts what is to be written next into batch_. True: the caller, and nobody else, must Send it.
  bool BeginWriting(Time now);
  /// Hands batch_ to the store.
  void Send();
  /// Goes on with what takes the job, which the store has given back: by JoinTake if it can.
  void ResumeTake();
  /// Joins what takes the job, if the store has not begun with that, and pending_ into one batch:
  /// so a run that is shorter than the store's turn costs one change.
  void JoinTake();
  /// Waits until no batch is being written or to be tried again: kIdle, or kLost.
  Disk AwaitIdle();
  /// Goes on after a batch was stored, or not. On the store's thread.
  void Written(const absl::StatusOr<std::uint64_t>& first);
  /// Waits for space, or ends the run. On the store's thread.
  void Failed(const absl::Status& status);
  /// Tells the caller of Finish that the end of the job cannot be stored.
  void GiveUpStoring();
  /// True if the worker has called Finish, so that whoever calls this must go on writing.
  bool SetDisk(Disk disk);

  Store& store_;
  const Clock& clock_;
  const std::string name_;
  const std::shared_ptr<JobLog> log_;
  const std::shared_ptr<RunControl> run_;
  const std::stop_token shutdown_;

  // Used by the worker's thread up to Finish, and after it by whoever got true from BeginWriting.
  /// What was added and not handed to the store.
  Batch pending_;
  /// When the last batch was sent.
  Time last_write_ = {};
  /// Keeps the run from being given up from Finish until its end is stored.
  std::optional<RunControl::Hold> hold_;
  /// What takes the job, and its events for the log in memory; null until that was sent.
  std::shared_ptr<const JobChange> take_;

  // Used by the store's thread while disk_ is kWriting, else as above.
  /// What is being written, or to be tried again.
  Batch batch_;
  /// Epoch of the stored job.
  std::uint64_t epoch_;

  mutable Mutex mutex_;
  /// Notified when disk_ changes.
  std::condition_variable_any changed_;
  Disk disk_ ABSL_GUARDED_BY(mutex_) = Disk::kIdle;
  /// True once Finish was called.
  bool finishing_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace contact
