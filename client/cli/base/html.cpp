#include "cli/base/html.h"

#include <fmt/format.h>

#include <cstddef>

#include "cli/base/escape.h"

namespace contact::cli {
namespace {

constexpr char kStyle[] =
    "body{font:15px/1.45 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;"
    "color:#1a1a1a;background:#fff}"
    "h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2.2rem}"
    "table{border-collapse:collapse;display:block;overflow-x:auto;font-variant-numeric:tabular-"
    "nums;"
    "font-size:.82rem;margin:.8rem 0}"
    "th,td{padding:.2rem .35rem;text-align:left;border-bottom:1px solid #ddd;vertical-align:top}"
    "th{vertical-align:bottom}.n{text-align:right}td.n{white-space:nowrap}tr.d{background:#fde7d9}"
    "svg{max-width:100%;height:auto}"
    "pre{background:#f5f5f5;padding:.7rem;overflow-x:auto;font-size:.82rem}"
    "figure{margin:1rem 0}";

bool IsNumber(std::string_view cell) {
  return !cell.empty() && cell.find_first_of("0123456789+-") == 0;
}

// A column is aligned as most of its cells are.
bool HoldsNumbers(const std::vector<HtmlRow>& rows, std::size_t column) {
  std::ptrdiff_t numbers = 0;
  std::ptrdiff_t words = 0;
  for (const HtmlRow& row : rows) {
    const std::string& cell = row.cells[column];
    if (!cell.empty()) ++(IsNumber(cell) ? numbers : words);
  }
  return numbers > words;
}

std::string Cell(std::string_view element, bool number, const std::string& text) {
  return fmt::format("<{0}{1}>{2}</{0}>", element, number ? " class=\"n\"" : "", HtmlText(text));
}

}  // namespace

std::string HtmlTable(const std::vector<std::string>& headers, const std::vector<HtmlRow>& rows) {
  std::vector<bool> numbers;
  std::string table = "<table>\n<tr>";
  for (std::size_t i = 0; i < headers.size(); ++i) {
    numbers.push_back(HoldsNumbers(rows, i));
    table += Cell("th", numbers[i], headers[i]);
  }
  table += "</tr>\n";
  for (const HtmlRow& row : rows) {
    table += row.differs ? "<tr class=\"d\">" : "<tr>";
    for (std::size_t i = 0; i < headers.size(); ++i) table += Cell("td", numbers[i], row.cells[i]);
    table += "</tr>\n";
  }
  return table + "</table>\n";
}

std::string HtmlPage(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
      HtmlText(title), kStyle, body);
}

}  // namespace contact::cli
