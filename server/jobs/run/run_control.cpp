#include "jobs/run/run_control.h"

#include <fmt/format.h>

#include <string>

#include "base/spelling.h"

namespace contact {
namespace {

// The ledger of a run may take the memory of its budget divided by this.
constexpr std::int64_t kLedgerShare = 4;

Transition OverBudget(const char* state_reason, const std::string& what) {
  return {v1::Job::FAILED, state_reason, fmt::format("the budget of {} was spent", what),
          absl::StatusCode::kResourceExhausted};
}

}  // namespace

void RunControl::Stop(StopCause cause) {
  StopCause server = StopCause::kServer;
  cause_.compare_exchange_strong(server, cause);
  stop_.request_stop();
}

void RunControl::CountSteps(std::int64_t steps) {
  const std::int64_t used = steps_.fetch_add(steps, std::memory_order_relaxed) + steps;
  if (budget_.steps > 0 && used > budget_.steps) Stop(StopCause::kSteps);
}

bool RunControl::CountOutput(std::int64_t bytes) {
  const std::int64_t used = output_bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  if (budget_.output_bytes == 0 || used <= budget_.output_bytes) return true;
  Stop(StopCause::kOutput);
  return false;
}

void RunControl::CountLedger(std::int64_t bytes) {
  const std::int64_t used = ledger_bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  if (budget_.memory_bytes > 0 && used > budget_.memory_bytes / kLedgerShare) {
    Stop(StopCause::kMemory);
  }
}

RunControl::Hold::Hold(RunControl& run) : run_(run), held_(run.Enter()) {}

RunControl::Hold::~Hold() {
  if (!held_) return;
  const MutexLock lock(run_.mutex_);
  --run_.holds_;
}

bool RunControl::Enter() {
  const MutexLock lock(mutex_);
  if (!given_up_) ++holds_;
  return !given_up_;
}

bool RunControl::held() const {
  const MutexLock lock(mutex_);
  return holds_ > 0;
}

bool RunControl::GiveUp() {
  const MutexLock lock(mutex_);
  given_up_ = given_up_ || holds_ == 0;
  return given_up_;
}

Transition TransitionAfterStop(StopCause cause, const RunBudget& budget) {
  switch (cause) {
    case StopCause::kWallTime:
      return OverBudget(
          reason::kBudgetWallTime,
          fmt::format("{} s wall time", static_cast<double>(budget.wall_time.count()) / 1000));
    case StopCause::kSteps:
      return OverBudget(reason::kBudgetSteps, Count(budget.steps, "step", "steps"));
    case StopCause::kOutput:
      return OverBudget(reason::kBudgetOutput,
                        Count(budget.output_bytes, "byte", "bytes") + " of output");
    case StopCause::kMemory:
      return OverBudget(
          reason::kBudgetMemory,
          Count(budget.memory_bytes / kLedgerShare, "byte", "bytes") + " of memory for the ledger");
    case StopCause::kStalled:
      return {v1::Job::FAILED, reason::kStalled, "the run made no step for too long",
              absl::StatusCode::kDeadlineExceeded};
    case StopCause::kServer:
    case StopCause::kUser:
      break;
  }
  return {v1::Job::CANCELLED, reason::kUserRequest};
}

}  // namespace contact
