#include "jobs/run/sweep_run.h"

#include <utility>

namespace contact {

SweepRun::SweepRun(v1::Sweep sweep, DecodedSweep plan, std::vector<bool> done, const Clock& clock,
                   const JobOptions& options, std::shared_ptr<RunControl> control, Sink sink)
    : sweep_(std::move(sweep)),
      plan_(std::move(plan)),
      done_(std::move(done)),
      clock_(clock),
      options_(options),
      control_(std::move(control)),
      sink_(std::move(sink)) {
  const MutexLock lock(mutex_);
  SkipDone();
}

void SweepRun::SkipDone() {
  while (next_ < plan_.axes.cells() && done_[static_cast<std::size_t>(next_)]) ++next_;
}

bool SweepRun::HasWork() const {
  const MutexLock lock(mutex_);
  return HasWorkLocked();
}

bool SweepRun::HasWorkLocked() const {
  return (!left_.empty() || next_ < plan_.axes.cells()) && !control_->stopping();
}

std::optional<std::int32_t> SweepRun::Claim() {
  const MutexLock lock(mutex_);
  if (!HasWorkLocked()) return std::nullopt;
  ++begun_;
  if (!left_.empty()) {
    const std::int32_t cell = left_.back();
    left_.pop_back();
    return cell;
  }
  const std::int32_t cell = next_++;
  SkipDone();
  return cell;
}

void SweepRun::Release(std::int32_t cell, bool computed) {
  const MutexLock lock(mutex_);
  if (!computed) left_.push_back(cell);
  --begun_;
  released_.notify_all();
}

bool SweepRun::Work(std::chrono::milliseconds slice, const std::function<bool()>& leave) {
  const auto end = clock_.Elapsed() + slice;
  std::optional<std::int32_t> index = Claim();
  if (!index) return false;
  CellSolver solver(sweep_, plan_, options_);
  while (index) {
    auto cell = solver.Solve(*index, *control_, {sink_.write, leave});
    const bool computed = cell.has_value();
    if (computed) sink_.store(*std::move(cell));
    Release(*index, computed);
    if (!computed || clock_.Elapsed() >= end) break;
    index = Claim();
  }
  return true;
}

bool SweepRun::AwaitEnd(std::chrono::milliseconds limit) {
  const MutexLock lock(mutex_);
  if (begun_ > 0 && !HasWorkLocked()) released_.wait_for(mutex_, limit);
  return begun_ == 0 && !HasWorkLocked();
}

}  // namespace contact
