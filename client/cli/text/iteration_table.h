#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/event.pb.h"

namespace contact::cli {

/// The header of the table of the μ-iteration. Wide tables have the bracket of μ, too.
std::string IterationHeader(const Style& style);

/// The row of one unknown in one pass of an iteration, below IterationHeader.
std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style);

}  // namespace contact::cli
