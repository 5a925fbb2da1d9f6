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
  struct Place {
    std::string name;
    std::uint64_t epoch;  ///< That the job has now; the writer takes it from there.
    std::shared_ptr<JobLog> log;
  };
  /// To be made shared. Stops `run` when nothing can be stored any more; once that is given up,
  /// nothing is stored any more. Gives up waiting for space when `shutdown` is requested.
  LogWriter(Store& store, Place place, std::shared_ptr<RunControl> run, std::stop_token shutdown);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Takes the job over: stores it with these events and a new epoch. Does not wait.
  void Take(v1::Job job, std::vector<v1::Event> events);

  /// False: it was not taken, because the run has spent its budget or was given up.
  bool Add(v1::Event event);
  /// Stores where the run may go on, together with what was added before, and soon.
  void AddCheckpoint(std::string state);
  /// Writes what has waited long enough. To be called now and then.
  void Pump();

  /// What was not handed to the store yet takes so many bytes of memory, about.
  std::size_t pending_bytes() const { return pending_.bytes; }

  /// Whether what was handed to the store found no space, and is to be tried again.
  bool out_of_space() const {
    const MutexLock lock(mutex_);
    return disk_ == Disk::kFull;
  }

  /// Called with the job once it is on disk with all its events and the log has them; with null if
  /// it cannot be stored. On the store's thread, or in Finish if the store had failed before.
  using Ended = std::function<void(const v1::Job*)>;
  /// Stores the job with the last event, after all that was added. Does not wait; until `ended` is
  /// called the run counts as reporting. False: it was given up, and `ended` is not called.
  bool Finish(v1::Job job, v1::Event event, Ended ended);
  /// Tries again what there was no space for, if it is time. To be called now and then after
  /// Finish, on any thread.
  void Retry();

 private:
  enum class Disk {
    kIdle,
    kWriting,  ///< batch_ belongs to the store's thread.
    kFull,     ///< batch_ is to be tried again.
    kLost,     ///< Nothing can be stored any more.
  };
  struct Batch {
    std::vector<v1::Event> events;  ///< Until they are encoded.
    std::size_t bytes = 0;
    bool take = false;
    bool failed = false;  ///< Once at least.
    std::optional<v1::Job> job;
    std::optional<Checkpoint> checkpoint;
    Ended ended;
    std::shared_ptr<const JobChange> encoded;  ///< All of it, once it is complete.
    std::vector<LogRecord> records;            ///< The events then, for the log.
  };
  using Time = std::chrono::steady_clock::time_point;

  void WriteWhatIsDue();
  void Encode(Batch* batch) const;
  void Advance(Time now);
  bool BeginWriting(Time now);
  void Send();
  Disk Settle();
  void Written(const absl::StatusOr<std::uint64_t>& first);
  void Failed(const absl::Status& status);
  void Lose();
  bool Become(Disk disk);

  Store& store_;
  const std::string name_;
  const std::shared_ptr<JobLog> log_;
  const std::shared_ptr<RunControl> run_;
  const std::stop_token shutdown_;

  // Of the worker's thread up to Finish, then guarded by mutex_.
  Batch pending_;
  Time last_write_ = {};
  std::optional<RunControl::Report> report_;  ///< Since Finish.

  // Of the store's thread while kWriting, else as above.
  Batch batch_;
  std::uint64_t epoch_;

  mutable Mutex mutex_;
  std::condition_variable_any changed_;
  Disk disk_ ABSL_GUARDED_BY(mutex_) = Disk::kIdle;
  bool finishing_ ABSL_GUARDED_BY(mutex_) = false;  ///< The worker is gone.
};

}  // namespace contact
