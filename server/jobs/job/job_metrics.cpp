#include "jobs/job/job_metrics.h"

#include <google/protobuf/util/time_util.h>

#include "jobs/job/lifecycle.h"

namespace contact {
namespace {

double Seconds(const google::protobuf::Timestamp& from, const google::protobuf::Timestamp& to) {
  using google::protobuf::util::TimeUtil;
  return static_cast<double>(TimeUtil::DurationToNanoseconds(to - from)) * 1e-9;
}

}  // namespace

void JobMetrics::Moved(v1::Job::State from, const v1::Job& job) {
  {
    const MutexLock lock(mutex_);
    ++moves_[{job.state(), job.state_reason()}];
  }
  if (job.state() == v1::Job::RUNNING && job.attempt() == 1) {
    wait_seconds.Count(Seconds(job.create_time(), job.start_time()));
  }
  if (from == v1::Job::RUNNING && IsFinal(job.state())) Ended(job);
}

void JobMetrics::Ended(const v1::Job& job) {
  run_seconds.Count(Seconds(job.start_time(), job.end_time()));
  for (const v1::Cycle& cycle : job.cycles()) iterations.Count(cycle.iterations());
  steps += job.summary().steps();
  growths += job.summary().growths();
}

JobMetrics::Moves JobMetrics::moves() const {
  const MutexLock lock(mutex_);
  return moves_;
}

}  // namespace contact
