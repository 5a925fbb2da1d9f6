#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "contact/v1/event.pb.h"
#include "jobs/job/job_options.h"
#include "jobs/run/run_control.h"
#include "wire/sweep/sweep_codec.h"
#include "wire/sweep/sweep_fields.h"

namespace contact {

/// A computed cell of a sweep.
struct SolvedCell {
  /// Values, state and metrics.
  v1::SweepCell cell;
  /// Empty unless the sweep keeps the cell's trajectory.
  std::vector<v1::FrameChunk> trajectory;
};

/// The events of a computed cell, in the order of the log: what was kept of it, then the cell.
std::vector<v1::Event> ToEvents(SolvedCell solved, std::chrono::system_clock::time_point now);

/// What a thread does now and then while it computes a cell.
struct Meanwhile {
  std::function<void()> write;
  /// Called every few steps. True: the cell is to be left, somebody else needs the thread.
  std::function<bool()> leave;
};

/// Computes cells of a sweep, one at a time. Holds a copy of the base scenario. Not thread-safe:
/// each thread that computes has a solver of its own.
class CellSolver {
 public:
  /// Sweep, plan and options outlive the solver.
  CellSolver(const v1::Sweep& sweep, const DecodedSweep& plan, const JobOptions& options);

  /// Computes the cell with this number: a pure function of the sweep and the number. Counts its
  /// steps on `control`. Nothing if the run was stopped or the cell was left.
  std::optional<SolvedCell> Solve(std::int32_t index, RunControl& control,
                                  const Meanwhile& meanwhile);

 private:
  /// Fills `solved`, whose index is set. False if there is no result.
  bool Compute(RunControl& control, const Meanwhile& meanwhile, SolvedCell* solved);
  /// Solves the scenario of a cell and takes over its result, with its trajectory if the sweep
  /// keeps it. False if there is none.
  bool Run(const Scenario& scenario, bool keeps, RunControl& control, const Meanwhile& meanwhile,
           SolvedCell* solved) const;

  const v1::Sweep& sweep_;
  const DecodedSweep& plan_;
  const JobOptions& options_;
  /// Stays empty: the fields were checked when the sweep was.
  std::vector<Violation> none_;
  /// Sets the values of a cell in a copy of the base scenario.
  SweepFields fields_;
};

}  // namespace contact
