#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

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

int Widest(const std::vector<std::string>& texts) {
  int widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, Width(TrimRight(text)));
  return widest;
}

}  // namespace

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
    if (style.wide || columns_[i].spare != kOnlyWide) layout.shown.push_back(i);
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
  while (layout.Total() > style.width) {
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
    if (label + kGap + Width(cell.text) <= style.width) {
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
  const std::size_t head = most == 0 || rows_.size() <= most ? rows_.size() : most / 2;
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

}  // namespace contact::cli
