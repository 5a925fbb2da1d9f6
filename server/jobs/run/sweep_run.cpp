#include "jobs/run/sweep_run.h"

#include <algorithm>
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
  waiting_ = static_cast<std::int32_t>(std::ranges::count(done_, false));
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
  --waiting_;
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
  if (!computed) {
    left_.push_back(cell);
    ++waiting_;
  }
  --begun_;
  released_.notify_all();
}

std::optional<SweepRun::Cells> SweepRun::Lend(std::int32_t most) {
  const MutexLock lock(mutex_);
  const std::int32_t end = plan_.axes.cells();
  if (next_ >= end || most < 1 || control_->stopping()) return std::nullopt;
  Cells cells{next_, next_};
  while (cells.count() < most && cells.last + 1 < end &&
         !done_[static_cast<std::size_t>(cells.last + 1)]) {
    ++cells.last;
  }
  next_ = cells.last + 1;
  SkipDone();
  begun_ += cells.count();
  waiting_ -= cells.count();
  return cells;
}

void SweepRun::PutBack(const Cells& cells) {
  const MutexLock lock(mutex_);
  for (std::int32_t cell = cells.first; cell <= cells.last; ++cell) left_.push_back(cell);
  begun_ -= cells.count();
  waiting_ += cells.count();
  released_.notify_all();
}

void SweepRun::Returned(const CellCounts& counts) {
  control_->CountSteps(counts.steps);
  sink_.count(counts);
  const MutexLock lock(mutex_);
  begun_ -= counts.cells;
  released_.notify_all();
}

std::int32_t SweepRun::waiting() const {
  const MutexLock lock(mutex_);
  return waiting_;
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
