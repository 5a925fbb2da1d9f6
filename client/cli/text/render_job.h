#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/base/table.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The columns of a job's ledger.
std::vector<Table::Column> LedgerColumns();

/// A job for people: state, ledger, final bodies, balances, warnings. The
/// columns of the style are those of its ledger.
std::string RenderJob(const v1::Job& job, const Style& style);

/// `SUCCEEDED`, in its colour.
Tone ToneOf(v1::Job::State state);
Tone ToneOf(v1::Cycle::Status status);

/// α of a collision; μ/k of a cycle that starts at rest, which has no α.
std::string AlphaOrRatio(const v1::Cycle& cycle);

/// |ε_out − ε_in|/ε_in; NaN if one of them is.
double RestitutionError(double restitution_out, double restitution_in);

}  // namespace contact::cli
