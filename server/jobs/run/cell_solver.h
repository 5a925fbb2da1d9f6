#pragma once

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

/// What a cell gave.
struct SolvedCell {
  v1::SweepCell cell;
  std::vector<v1::FrameChunk> trajectory;  ///< If it is to be kept.
};

/// Computes cells of a sweep, one at a time. Has a copy of the base scenario; of one thread.
class CellSolver {
 public:
  /// All outlive the solver.
  CellSolver(const v1::Sweep& sweep, const DecodedSweep& plan, const JobOptions& options);

  /// The cell with this number; none if it was stopped. `pulse` is called now and then meanwhile.
  /// A pure function of the sweep and the number.
  std::optional<SolvedCell> Solve(std::int32_t index, RunControl& control,
                                  const std::function<void()>& pulse);

 private:
  // False if the run was stopped.
  bool Compute(RunControl& control, const std::function<void()>& pulse, SolvedCell* solved);
  bool Run(const Scenario& scenario, RunControl& control, const std::function<void()>& pulse,
           SolvedCell* solved) const;
  bool Keeps(std::int32_t cell) const;

  const v1::Sweep& sweep_;
  const DecodedSweep& plan_;
  const JobOptions& options_;
  std::vector<Violation> none_;  ///< The fields were checked when the sweep was.
  SweepFields fields_;
};

}  // namespace contact
