#include "cli/paper/index.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/spelling.h"
#include "cli/base/escape.h"
#include "cli/base/html.h"
#include "cli/base/number.h"

namespace contact::cli {
namespace {

constexpr char kReading[] =
    "<p><b>Published</b> is what the paper prints. <b>By its process</b> is ours, computed as the "
    "paper says it did: Runge-Kutta with 1e-6 s, its updates of μ, its tolerance and its "
    "definition of the phases. <b>Converged</b> is ours by the default solver, to 1e-8. A "
    "deviation of process from print beyond the documented limit is marked.</p>\n";

std::vector<std::string> Cells(const Comparison& n) {
  return {n.what,
          Short(n.published),
          Short(n.process),
          Short(n.converged),
          DeviationText(n),
          LimitText(n),
          n.why};
}

// Columns of which no number has anything are left out.
std::string Numbers(const PaperItem& item) {
  const std::vector<std::string> all = {
      "Number", "Published", "By its process", "Converged", "Deviation", "Limit", "Why"};
  std::vector<std::string> headers;
  std::vector<HtmlRow> rows;
  for (const Comparison& n : item.numbers) rows.push_back({{}, !n.holds()});
  for (std::size_t column = 0; column < all.size(); ++column) {
    std::vector<std::string> cells;
    for (const Comparison& n : item.numbers) cells.push_back(Cells(n)[column]);
    if (std::ranges::all_of(cells, &std::string::empty)) continue;
    headers.push_back(all[column]);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].cells.push_back(std::move(cells[i]));
  }
  return HtmlTable(headers, rows);
}

std::string Files(const PaperItem& item) {
  std::vector<std::string> links;
  for (const Data& data : item.data) {
    links.push_back(
        fmt::format("<a href=\"{0}.csv\">{0}.csv</a>, {1}{2}", data.name,
                    Count(static_cast<std::int64_t>(data.rows.size()), "row", "rows"),
                    data.note.empty() ? "" : fmt::format(" ({})", HtmlText(data.note))));
  }
  return links.empty() ? "" : fmt::format("<p>Data: {}.</p>\n", fmt::join(links, "; "));
}

std::string Section(const PaperItem& item, const std::map<std::string, std::string>& figures) {
  std::string section =
      fmt::format("<h2 id=\"{0}\">{0}: {1}</h2>\n", item.id, HtmlText(item.title));
  const auto figure = figures.find(item.id);
  if (figure != figures.end()) section += fmt::format("<figure>{}</figure>\n", figure->second);
  if (!item.note.empty()) section += fmt::format("<p>{}</p>\n", HtmlText(item.note));
  if (!item.numbers.empty()) section += Numbers(item);
  return section + Files(item);
}

bool IsCompared(const PaperItem& item) {
  return std::ranges::any_of(item.numbers, [](const auto& n) { return !std::isnan(n.limit); });
}

}  // namespace

std::string IndexPage(const std::vector<PaperItem>& items,
                      const std::map<std::string, std::string>& figures, const Origin& origin) {
  std::string body = kReading;
  std::vector<HtmlRow> verdicts;
  for (const PaperItem& item : items) {
    verdicts.push_back({{item.id, item.title,
                         !IsCompared(item) ? "shown"
                         : item.holds()    ? "holds"
                                           : "DIFFERS"},
                        !item.holds()});
  }
  body += HtmlTable({"Item", "What it shows", "Verdict"}, verdicts);
  if (figures.empty()) {
    body += "<p>Figures were not drawn: gnuplot was not there. Their data are.</p>\n";
  }
  for (const PaperItem& item : items) body += Section(item, figures);
  body += fmt::format(
      "<h2>How to make this again</h2>\n<pre>{}</pre>\n<p>Made by {}. Solver of the converged "
      "numbers: <code>{}</code></p>\n",
      HtmlText(origin.command), HtmlText(origin.server), HtmlText(origin.solver));
  return HtmlPage("The paper's figures and tables, made again", body);
}

}  // namespace contact::cli
