#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/paper/report.h"

namespace contact::cli {

/// What made the items.
struct Origin {
  std::string server;   ///< Version and revision.
  std::string solver;   ///< Of the converged numbers, as JSON.
  std::string command;  ///< That makes the page again.
};

/// One page with everything: numbers, figures (SVG by id; without one its data alone), and how to
/// make it again. Needs nothing but itself.
std::string IndexPage(const std::vector<PaperItem>& items,
                      const std::map<std::string, std::string>& figures, const Origin& origin);

}  // namespace contact::cli
