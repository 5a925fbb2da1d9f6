#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/event.pb.h"

namespace contact::cli {

/// The header of the table of the μ-iteration. Wide tables, and terminals of 120 columns or more,
/// have the bracket of μ, too. Terminals of less than 80 have no episode and next step; those of
/// less than 60 no ε either, and μ in six digits, so that a row fits into 40.
std::string IterationHeader(const Style& style);

/// The row of one unknown in one pass of an iteration, below IterationHeader.
std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style);

}  // namespace contact::cli
