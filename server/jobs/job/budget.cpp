#include "jobs/job/budget.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>

namespace contact {
namespace {

// The smaller one, where 0 is no limit.
template <class T>
T Smaller(T asked, T limit) {
  if (asked <= T{0}) return limit;
  return limit <= T{0} ? asked : std::min(asked, limit);
}

}  // namespace

RunBudget BudgetOf(const v1::Job& job, const RunBudget& limits) {
  const v1::Budget& budget = job.budget();
  const std::chrono::milliseconds wall_time(
      google::protobuf::util::TimeUtil::DurationToMilliseconds(budget.wall_time()));
  return {Smaller(wall_time, limits.wall_time), Smaller(budget.steps(), limits.steps),
          Smaller(budget.output_bytes(), limits.output_bytes), limits.memory_bytes};
}

}  // namespace contact
