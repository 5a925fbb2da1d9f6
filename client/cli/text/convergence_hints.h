#pragma once

#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Lines, each with its end, about what may help where cycles of a finished run miss their
/// restitution: a setting to try for each cause that the ledger shows, and where none would help
/// what can be reached. Empty if the run is FULL or the ledger shows no such cycle.
std::string ConvergenceHints(const v1::Job& job);

}  // namespace contact::cli
