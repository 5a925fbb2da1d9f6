#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Pieces of a page that needs nothing but itself: no scripts, nothing from elsewhere.

/// `text` with the special characters of HTML escaped, so that it cannot become markup.
std::string HtmlText(std::string_view text);

/// A row of a table.
struct HtmlRow {
  std::vector<std::string> cells;  ///< Plain text, one a column.
  bool differs = false;            ///< The row is marked.
};

/// A table. A column of which most cells begin with a digit or sign is aligned to the right.
std::string HtmlTable(const std::vector<std::string>& headers, const std::vector<HtmlRow>& rows);

/// A whole page with `title`, plain text, as title and heading; `body` is markup.
std::string HtmlPage(std::string_view title, std::string_view body);

}  // namespace contact::cli
