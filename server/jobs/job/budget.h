#pragma once

#include <chrono>
#include <cstdint>

#include "contact/v1/job.pb.h"

namespace contact {

/// What a run may use; 0: as much as it likes.
struct RunBudget {
  std::chrono::milliseconds wall_time{0};
  std::int64_t steps = 0;
  std::int64_t output_bytes = 0;
  /// Memory of the worker for the run. Set by the server alone.
  std::int64_t memory_bytes = 0;
};

/// The budget of a job: what it asks for, but no more than `limits`.
RunBudget BudgetOf(const v1::Job& job, const RunBudget& limits);

}  // namespace contact
