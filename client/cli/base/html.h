#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Pieces of an HTML page that refers to nothing else: no scripts, style sheets, fonts or files.

/// A row of a table.
struct HtmlRow {
  /// Plain text, one a column.
  std::vector<std::string> cells;
  /// True for a row with a coloured background, to be noticed.
  bool differs = false;
};

/// A table. A column of which most cells begin with a digit or sign is aligned to the right.
std::string HtmlTable(const std::vector<std::string>& headers, const std::vector<HtmlRow>& rows);

/// A whole page with `title`, plain text, as title and heading; `body` is markup.
std::string HtmlPage(std::string_view title, std::string_view body);

}  // namespace contact::cli
