#include "jobs/run/sweep_runner.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/spelling.h"
#include "jobs/run/replay.h"
#include "wire/scenario_advice.h"

namespace contact {
namespace {

constexpr std::chrono::milliseconds kSlice{1000};
// How often what was handed to the log is written while its owner only waits for helpers.
constexpr std::chrono::milliseconds kWriteTime{20};
constexpr std::chrono::milliseconds kSweepProgressTime{100};
// Cells that may be finished while somebody else is at the log, a few milliseconds' worth.
constexpr std::size_t kMaxFinished = 64;

}  // namespace

SweepRunner::SweepRunner(Store& store, const Clock& clock, const JobOptions& options,
                         const Assignment& assignment, LogWriter& writer)
    : store_(store), clock_(clock), options_(options), assignment_(assignment), writer_(writer) {}

Transition SweepRunner::Run(const v1::Sweep& sweep) {
  DecodedSweep plan = DecodeSweep(sweep, options_.scenario_limits);
  if (!plan.violations.empty()) {
    const Violation& first = plan.violations.front();
    return TransitionAfterFault("sweep." + first.field + ": " + first.description);
  }
  const std::int32_t cells = plan.axes.cells();
  const std::vector<Violation> advice = AdviseOnTime(sweep, plan);
  std::vector<bool> done(static_cast<std::size_t>(cells));
  if (!ReadDone(&done))
    return TransitionAfterFault("the cells of an earlier attempt cannot be read");
  {
    const MutexLock lock(log_mutex_);
    progress_.set_cells(cells);
    Publish();
  }
  const SweepRun::Sink sink{[this](SolvedCell solved) { TakeCell(std::move(solved)); },
                            [this] { WriteIfDue(); },
                            [this](const CellCounts& counts) { TakeCounts(counts); }};
  const auto run = std::make_shared<SweepRun>(sweep, std::move(plan), std::move(done), clock_,
                                              options_, assignment_.control, sink);
  if (const RunControl::Hold hold(*assignment_.control); hold) assignment_.offer(run);
  do {
    while (run->Work(kSlice, [this] { return Yield(); })) Yield();
    WriteIfDue();
    Yield();
  } while (!run->AwaitEnd(kWriteTime));
  return Conclude(advice);
}

bool SweepRunner::Yield() {
  if (assignment_.control->yielding()) assignment_.yield();
  return false;
}

bool SweepRunner::ReadDone(std::vector<bool>* done) {
  const MutexLock lock(log_mutex_);
  const v1::Job& job = assignment_.job;
  const EventQuery cells{.name = job.name(), .kinds = KindBit(v1::Event::kSweepCell)};
  return ForEachEvent(store_, cells, job.last_sequence(), *assignment_.control,
                      [&](const StoredEvent& stored) ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_) {
                        v1::Event event;
                        const auto index = static_cast<std::size_t>(
                            stored.Parse(&event) ? event.sweep_cell().index() : -1);
                        if (index >= done->size() || (*done)[index]) return true;
                        (*done)[index] = true;
                        Count(event.sweep_cell().state(), event.sweep_cell().convergence());
                        return true;
                      });
}

void SweepRunner::Count(v1::Job::State state, v1::Job::Convergence convergence) {
  progress_.set_cells_done(progress_.cells_done() + 1);
  if (state == v1::Job::FAILED) {
    progress_.set_cells_failed(progress_.cells_failed() + 1);
  } else if (convergence != v1::Job::FULL) {
    progress_.set_cells_not_converged(progress_.cells_not_converged() + 1);
  }
}

// If another thread holds the log, the cell stays in finished_: the holder stores what is there
// before it releases the log.
void SweepRunner::TakeCell(SolvedCell solved) {
  if (PutFinished(std::move(solved))) {
    const MutexLock lock(log_mutex_);
    StoreFinished();
  }
  while (SomeFinished() && log_mutex_.try_lock()) {
    StoreFinished();
    log_mutex_.unlock();
  }
}

// True if so much is finished that it has to be in the log before anybody goes on.
bool SweepRunner::PutFinished(SolvedCell solved) {
  const bool large = !solved.trajectory.empty();
  const MutexLock lock(mutex_);
  finished_.push_back(std::move(solved));
  return large || finished_.size() >= kMaxFinished;
}

bool SweepRunner::SomeFinished() {
  const MutexLock lock(mutex_);
  return !finished_.empty();
}

// One after the other, so that never more than kMaxFinished wait for the log.
void SweepRunner::StoreFinished() {
  while (std::optional<SolvedCell> solved = NextFinished()) StoreCell(*std::move(solved));
}

std::optional<SolvedCell> SweepRunner::NextFinished() {
  const MutexLock lock(mutex_);
  if (finished_.empty()) return std::nullopt;
  SolvedCell solved = std::move(finished_.front());
  finished_.pop_front();
  return solved;
}

// What was kept of the cell stands before it in the log, and nothing between.
void SweepRunner::StoreCell(SolvedCell solved) {
  const v1::Job::State state = solved.cell.state();
  const v1::Job::Convergence convergence = solved.cell.convergence();
  for (v1::Event& event : ToEvents(std::move(solved), clock_.Now())) {
    if (!writer_.Add(std::move(event))) return;
  }
  Count(state, convergence);
  const auto now = clock_.Elapsed();
  if (now - last_progress_ < kSweepProgressTime) return;
  last_progress_ = now;
  Publish();
}

void SweepRunner::TakeCounts(const CellCounts& counts) {
  const MutexLock lock(mutex_);
  stored_.cells += counts.cells;
  stored_.failed += counts.failed;
  stored_.not_converged += counts.not_converged;
}

void SweepRunner::CountStored() {
  CellCounts counts;
  {
    const MutexLock lock(mutex_);
    counts = std::exchange(stored_, {});
  }
  if (counts.cells == 0) return;
  progress_.set_cells_done(progress_.cells_done() + counts.cells);
  progress_.set_cells_failed(progress_.cells_failed() + counts.failed);
  progress_.set_cells_not_converged(progress_.cells_not_converged() + counts.not_converged);
  Publish();
}

// Also a cell that was finished while another worker was here.
void SweepRunner::WriteIfDue() {
  if (!log_mutex_.try_lock()) return;
  CountStored();
  if (std::optional<SolvedCell> solved = NextFinished()) StoreCell(*std::move(solved));
  writer_.WriteIfDue();
  log_mutex_.unlock();
}

void SweepRunner::Publish() {
  v1::Event event = EventAt(clock_.Now());
  *event.mutable_progress() = progress_;
  assignment_.record->Do([&](v1::Job& job) { *job.mutable_progress() = event.progress(); });
  assignment_.log->SetProgress(std::move(event));
}

Transition SweepRunner::Conclude(const std::vector<Violation>& advice) {
  const MutexLock lock(log_mutex_);
  StoreFinished();
  CountStored();
  Publish();
  if (progress_.cells_done() < progress_.cells()) return {v1::Job::CANCELLED, reason::kUserRequest};
  const std::int32_t cells = progress_.cells(), failed = progress_.cells_failed();
  const bool full = failed == 0 && progress_.cells_not_converged() == 0;
  assignment_.record->Do([&](v1::Job& job) {
    job.set_convergence(full ? v1::Job::FULL : v1::Job::PARTIAL);
    if (failed > 0) {
      const std::string all = contact::Count(cells, "cell", "cells");
      job.add_warnings(fmt::format("{} of {} failed", failed, all));
    }
    for (const Violation& a : advice) job.add_warnings(Text(a));
  });
  return {v1::Job::SUCCEEDED};
}

}  // namespace contact
