#pragma once

#include <ostream>
#include <vector>

#include "simulation/campaign/result.h"

namespace contact::campaign {

/// Counts by kind, in the order of the results, and of all.
void WriteTable(const std::vector<Result>& results, std::ostream& out);

/// What got better and worse against an earlier campaign, of the kinds and seeds of both: by kind,
/// then each that ended otherwise, breaks more or fewer promises, or takes twice the steps or half.
void WriteAgainst(const std::vector<Result>& earlier, const std::vector<Result>& results,
                  std::ostream& out);

}  // namespace contact::campaign
