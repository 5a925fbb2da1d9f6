#pragma once

#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// What a report shows of one run.
struct RunPart {
  /// The job and its iterations; the trajectory is not needed.
  Recording recording;
  /// SVG elements, in the order in which the page shows them.
  std::vector<std::string> figures;
};

/// A page about one run, or about several and where they differ, with links to its parts at the
/// top. Needs nothing but itself.
/// `overlay` is SVG with several over each other, or empty; `server` is where they were read.
std::string ReportPage(const std::vector<RunPart>& runs, const std::string& overlay,
                       const std::string& server);

}  // namespace contact::cli
