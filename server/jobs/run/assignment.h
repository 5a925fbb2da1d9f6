#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "jobs/log/job_log.h"
#include "jobs/run/run_control.h"
#include "jobs/run/run_record.h"
#include "storage/records.h"

namespace contact {

class SweepRun;

/// A job handed to a worker.
struct Assignment {
  /// The header, in state RUNNING.
  v1::Job job;
  /// The job with its spec. Null: to be read from the store.
  std::shared_ptr<const StoredJob> spec;
  /// The state_changed event of RUNNING. Not stored yet.
  v1::Event event;
  /// Epoch of the stored job.
  std::uint64_t epoch;
  /// The log in memory, for watchers.
  std::shared_ptr<JobLog> log;
  /// Takes what the run brings.
  std::shared_ptr<RunRecord> record;
  /// Tells the run when to stop.
  std::shared_ptr<RunControl> control;
  /// Lets idle workers help with a sweep.
  std::function<void(std::shared_ptr<SweepRun>)> offer;
  /// Lets others compute, if the run was asked to yield, and returns when it is its turn again or
  /// it is to stop. To be called where the run holds no lock.
  std::function<void()> yield = [] {};
};

}  // namespace contact
