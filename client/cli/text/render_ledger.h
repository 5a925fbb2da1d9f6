#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/base/table.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The columns of a job's ledger, for --columns and its completion.
std::vector<Table::Column> LedgerColumns();

/// The contact cycles of a job as a table; of many cycles the middle is left out. Empty without
/// cycles.
std::string RenderLedger(const v1::Job& job, const Style& style);

/// The colour in which the status of a cycle is shown.
Tone ToneOf(v1::Cycle::Status status);

/// α of a collision [1]; μ/k [s/m] with its unit of a cycle that starts at rest, which has no α.
std::string AlphaOrRatio(const v1::Cycle& cycle);

/// ε_out of a cycle as people read it: NaN where ε says nothing, as of SETTLED and RELEASED cycles.
double RestitutionOf(const v1::Cycle& cycle);

/// |ε_out − ε_in|/ε_in; NaN if one of them is.
double RestitutionError(double restitution_out, double restitution_in);
/// The same of a cycle, see RestitutionOf.
double RestitutionError(const v1::Cycle& cycle);

}  // namespace contact::cli
