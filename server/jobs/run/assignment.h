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
  v1::Job job;                            ///< Header, RUNNING now.
  std::shared_ptr<const StoredJob> spec;  ///< Null: to be read from the store.
  v1::Event event;                        ///< That tells it; not stored yet.
  std::uint64_t epoch;                    ///< Of the stored job.
  std::shared_ptr<JobLog> log;
  std::shared_ptr<RunRecord> record;
  std::shared_ptr<RunControl> control;
  std::function<void(std::shared_ptr<SweepRun>)> offer;  ///< Lets idle workers help with a sweep.
};

}  // namespace contact
