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

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "jobs/job_log.h"
#include "jobs/run_control.h"
#include "storage/mutex.h"

namespace contact {

class Store;

/// Writes what happens to a job while one worker has it: to the store in batches, and once they
/// are committed to the job's log in memory.
///
/// Runs ahead of the disk by a few MiB at most, then makes the worker wait. While the store is
/// full it waits too, and tries again until there is space or the server stops. If events cannot
/// be stored at all it stops the run. Calls belong to the worker's thread.
class LogWriter {
 public:
  struct Place {
    std::string name;
    std::uint64_t epoch;  ///< That the job has now; the writer takes it from there.
    std::shared_ptr<JobLog> log;
  };
  /// Stops `run`, which outlives this, when nothing can be stored any more; once that is given up,
  /// nothing is stored any more. Gives up waiting for space when `shutdown` is requested.
  LogWriter(Store& store, Place place, RunControl& run, std::stop_token shutdown);
  /// Waits for the batch that is being written.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Takes the job over: stores it with these events and a new epoch. Does not wait.
  void Take(v1::Job job, std::vector<v1::Event> events);

  /// False: it was not taken, because the run has spent its budget or was given up.
  bool Add(v1::Event event);
  /// Writes what has waited long enough. To be called now and then.
  void Pump();

  /// Stores the job with the last event, and waits until all is on disk. `committed` is called
  /// then, on the store's thread, after the log has the events. False: it could not be stored.
  bool Finish(v1::Job job, v1::Event event, std::function<void()> committed);

 private:
  enum class Disk {
    kIdle,
    kWriting,  ///< batch_ belongs to the store's thread.
    kFull,     ///< batch_ is to be tried again.
    kLost,     ///< Nothing can be stored any more.
  };
  struct Batch {
    std::vector<v1::Event> events;
    std::size_t bytes = 0;
    bool take = false;
    bool failed = false;  ///< Once at least.
    std::optional<v1::Job> job;
    std::function<void()> committed;
  };
  using Time = std::chrono::steady_clock::time_point;

  void WriteWhatIsDue();
  void Advance(Time now);
  void Send(Time now);
  Disk Settle();
  void Written(const absl::StatusOr<std::uint64_t>& first);
  void Become(Disk disk);

  Store& store_;
  const std::string name_;
  const std::shared_ptr<JobLog> log_;
  RunControl& run_;
  const std::stop_token shutdown_;

  // Of the worker's thread.
  Batch pending_;
  Time last_write_ = {};

  // Of the store's thread while kWriting, else of the worker's.
  Batch batch_;
  std::uint64_t epoch_;

  Mutex mutex_;
  std::condition_variable_any changed_;
  Disk disk_ ABSL_GUARDED_BY(mutex_) = Disk::kIdle;
};

}  // namespace contact
