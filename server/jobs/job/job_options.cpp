#include "jobs/job/job_options.h"

#include <google/protobuf/util/time_util.h>

namespace contact {
namespace {

google::protobuf::Duration ToDuration(std::chrono::milliseconds span) {
  return google::protobuf::util::TimeUtil::MillisecondsToDuration(span.count());
}

}  // namespace

v1::ServerLimits LimitsOf(const JobOptions& options) {
  v1::ServerLimits limits;
  limits.set_max_bodies(options.scenario_limits.max_bodies);
  limits.set_max_contacts(options.scenario_limits.max_contacts);
  limits.set_max_samples(options.scenario_limits.max_samples);
  limits.set_max_queued_jobs(options.max_queued_jobs);
  limits.set_max_watchers(options.max_watchers);
  limits.set_max_cells(options.scenario_limits.max_cells);
  limits.set_max_disk_percent(options.max_disk_percent);
  limits.set_admin_slots(options.admin_slots);
  v1::Budget& budget = *limits.mutable_max_budget();
  *budget.mutable_wall_time() = ToDuration(options.max_budget.wall_time);
  budget.set_steps(options.max_budget.steps);
  budget.set_output_bytes(options.max_budget.output_bytes);
  if (options.step_timeout.count() > 0) {
    *limits.mutable_step_timeout() = ToDuration(options.step_timeout);
  }
  limits.set_max_attempts(options.max_attempts);
  const RetentionLimits& retention = options.retention;
  if (retention.age.count() > 0) *limits.mutable_retention() = ToDuration(retention.age);
  limits.set_retained_bytes(retention.bytes);
  if (retention.compact_after.count() > 0) {
    *limits.mutable_compaction() = ToDuration(retention.compact_after);
  }
  return limits;
}

}  // namespace contact
