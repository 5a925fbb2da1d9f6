#pragma once

#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// True for the status of a cycle or group that misses its restitution: NOT_CONVERGED, INFEASIBLE.
bool Misses(v1::Cycle::Status status);

/// How many cycles of a run miss their restitution, or how many cells of a sweep failed or did not
/// converge: `3`. `-` while that is not known.
std::string MissedCount(const v1::Job& job);

/// The convergence of a job with that count, and that of cycles that the end of the run cuts:
/// `FULL`, `FULL, 2 cycles cut by the end` or `PARTIAL (3 of 249 cycles)`. Empty while the job has
/// not finished.
std::string ConvergenceText(const v1::Job& job);

/// Drops the cycles and groups that do not miss their restitution. The counts of the summary stay
/// those of the whole ledger.
void KeepMissed(v1::Job* job);

/// Lines, each with its end, about what may help where cycles of a finished run miss their
/// restitution: a setting to try for each cause that the ledger shows, and where none would help
/// what can be reached. Empty if the run is FULL or the ledger shows no such cycle.
std::string ConvergenceHints(const v1::Job& job);

}  // namespace contact::cli
