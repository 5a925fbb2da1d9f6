#include "cli/base/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cctype>
#include <functional>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/csv.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

constexpr int kGap = 2;

// A header as parts that may stand below each other: `bodies`, `[0].`, `velocity_`, `m_`, ...
std::vector<std::string> Parts(const std::string& header) {
  std::vector<std::string> parts = {""};
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool ended = i > 0 && std::string_view(" ._").find(header[i - 1]) != std::string::npos;
    if (i > 0 && (ended || header[i] == '[')) parts.emplace_back();
    parts.back() += header[i];
  }
  return parts;
}

// The column of this name or header. Throws Failure (kUsage) if there is none.
std::size_t Find(const std::vector<Table::Column>& columns, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    known.push_back(columns[i].Name());
    if (boost::iequals(name, known.back()) || name == columns[i].header) return i;
  }
  const std::string hint = DidYouMean(name, {known.begin(), known.end()});
  throw Failure(ExitCode::kUsage,
                fmt::format("--columns: there is no column {}{} — there are {}", Quoted(name),
                            hint.empty() ? "" : ", " + hint, fmt::join(known, ", ")));
}

// Indices of the columns with these names, in the order of the names; of all columns for no names.
std::vector<std::size_t> Picked(const std::vector<Table::Column>& columns,
                                const std::vector<std::string>& names) {
  std::vector<std::size_t> picked;
  for (const std::string& name : names) picked.push_back(Find(columns, name));
  for (std::size_t i = 0; names.empty() && i < columns.size(); ++i) picked.push_back(i);
  return picked;
}

int Widest(const std::vector<std::string>& texts) {
  int widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, Width(TrimRight(text)));
  return widest;
}

}  // namespace

std::string Table::Column::Name() const {
  if (!name.empty()) return name;
  std::string made = header.substr(0, std::min(header.find(" ["), header.find(" (")));
  std::ranges::transform(made, made.begin(), [](unsigned char c) {
    return c == ' ' ? '_' : static_cast<char>(std::tolower(c));
  });
  return made;
}

void Table::RequireColumns(const std::vector<Column>& columns,
                           const std::vector<std::string>& names) {
  for (const std::string& name : names) Find(columns, name);
}

void Table::Add(std::vector<Cell> row) {
  for (Cell& cell : row) cell.text = Printable(cell.text, ' ');
  rows_.push_back(std::move(row));
}

int Table::WidestCell(std::size_t column) const {
  int widest = 0;
  for (const auto& row : rows_) widest = std::max(widest, Width(row[column].text));
  return widest;
}

int Table::Layout::Total() const {
  int total = -kGap;
  for (const std::size_t i : shown) total += widths[i] + kGap;
  return total;
}

Table::Layout Table::Full(const Style& style) const {
  Layout layout;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    layout.headers.push_back({columns_[i].header});
    layout.widths.push_back(std::max(Width(columns_[i].header), WidestCell(i)));
  }
  layout.shown = Picked(columns_, style.columns);
  if (!style.wide && style.columns.empty()) {
    std::erase_if(layout.shown, [this](std::size_t i) { return columns_[i].spare == kOnlyWide; });
  }
  return layout;
}

Table::Layout Table::Narrow(const Style& style) const {
  Layout layout = Full(style);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::vector<std::string> parts = Parts(columns_[i].header);
    layout.widths[i] = std::max(Widest(parts), WidestCell(i));
    layout.headers[i] = Fold(parts, layout.widths[i]);
  }
  while (style.columns.empty() && layout.Total() > style.width) {
    const auto spare = [this](std::size_t i) { return columns_[i].spare; };
    const auto first = std::ranges::max_element(layout.shown, {}, spare);
    if (columns_[*first].spare <= 0) break;
    layout.shown.erase(first);
  }
  return layout;
}

std::string Table::Header(const Layout& layout, const Style& style) const {
  std::size_t lines = 1;
  for (const std::size_t i : layout.shown) lines = std::max(lines, layout.headers[i].size());
  std::string text;
  for (std::size_t line = 0; line < lines; ++line) {
    std::string words;
    for (const std::size_t i : layout.shown) {
      const auto& header = layout.headers[i];
      const std::size_t above = lines - header.size();  // Empty lines.
      const std::string& part = line < above ? "" : header[line - above];
      if (i != layout.shown.front()) words += std::string(kGap, ' ');
      words += Paint(Pad(part, columns_[i].right ? -layout.widths[i] : layout.widths[i]),
                     Tone::kFaint, style);
    }
    text += TrimRight(std::move(words)) + "\n";
  }
  return text;
}

std::string Table::Row(const Layout& layout, std::size_t row, const Style& style) const {
  std::string text;
  for (const std::size_t i : layout.shown) {
    const Cell& cell = rows_[row][i];
    if (i != layout.shown.front()) text += std::string(kGap, ' ');
    text += Paint(Pad(cell.text, columns_[i].right ? -layout.widths[i] : layout.widths[i]),
                  cell.tone, style);
  }
  return TrimRight(std::move(text)) + "\n";
}

std::string Table::Block(const Layout& layout, std::size_t row, const Style& style) const {
  int label = 0;
  for (const std::size_t i : layout.shown) label = std::max(label, Width(columns_[i].header));
  std::string text = row == 0 ? "" : "\n";
  for (const std::size_t i : layout.shown) {
    const Cell& cell = rows_[row][i];
    const std::string words = Paint(cell.text, cell.tone, style) + "\n";
    if (cell.text.empty()) {
      text += Paint(columns_[i].header, Tone::kFaint, style) + "\n";
    } else if (label + kGap + Width(cell.text) <= style.width) {
      text.append(Paint(Pad(columns_[i].header, label), Tone::kFaint, style));
      text.append(kGap, ' ').append(words);
    } else {
      text += Paint(columns_[i].header, Tone::kFaint, style) + "\n" + Wrap(words, style);
    }
  }
  return text;
}

std::string Table::Text(const Style& style, std::size_t most, const std::string& more) const {
  const Layout full = Full(style);
  const Layout layout = style.width > 0 && full.Total() > style.width ? Narrow(style) : full;
  const bool blocks = style.width > 0 && layout.Total() > style.width;
  std::string text = blocks ? "" : Header(layout, style);
  const std::size_t head = most == 0 || rows_.size() <= most + 1 ? rows_.size() : most / 2;
  const std::size_t tail = head == rows_.size() ? rows_.size() : rows_.size() - (most - head);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (row == head) {
      text += Paint(fmt::format(fmt::runtime(more), tail - head), Tone::kFaint, style) + "\n";
      row = tail;
    }
    text += blocks ? Block(full, row, style) : Row(layout, row, style);
  }
  return text;
}

std::string Table::Csv(const std::vector<std::string>& names) const {
  const std::vector<std::size_t> picked = Picked(columns_, names);
  std::string text;
  CsvWriter csv(&text);
  for (const std::size_t i : picked) csv.Add(columns_[i].Name());
  csv.EndRow();
  for (const auto& row : rows_) {
    for (const std::size_t i : picked) csv.Add(row[i].text == "-" ? "" : row[i].text);
    csv.EndRow();
  }
  return text;
}

}  // namespace contact::cli
