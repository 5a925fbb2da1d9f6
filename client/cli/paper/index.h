#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/paper/report.h"

namespace contact::cli {

/// What made the items.
struct Origin {
  /// Version and revision of the server.
  std::string server;
  /// Options of the solver of the converged numbers, as JSON.
  std::string solver;
  /// The command that makes the page again.
  std::string command;
};

/// One HTML page with the numbers and figures of all items, links to their data, and how to make it
/// again. It refers to no file but the data. `figures` has SVG elements by the id of their item; an
/// item without one has its data alone.
std::string IndexPage(const std::vector<PaperItem>& items,
                      const std::map<std::string, std::string>& figures, const Origin& origin);

}  // namespace contact::cli
