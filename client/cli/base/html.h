#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Pieces of a page that needs nothing but itself: no scripts, nothing from elsewhere.

/// Text that cannot become markup.
std::string HtmlText(std::string_view text);

/// A table. Cells are text; a cell that begins with a digit or sign stands to the right. Rows with
/// `differs` set are marked.
struct HtmlRow {
  std::vector<std::string> cells;
  bool differs = false;
};
std::string HtmlTable(const std::vector<std::string>& headers, const std::vector<HtmlRow>& rows);

/// A whole page around a body of markup.
std::string HtmlPage(std::string_view title, std::string_view body);

}  // namespace contact::cli
