#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace contact::cli {
namespace {

constexpr int kGap = 2;

std::string TrimRight(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::vector<std::size_t> Table::ShownColumns(const std::vector<int>& widths,
                                             const Style& style) const {
  std::vector<std::size_t> shown;
  int total = -kGap;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    shown.push_back(i);
    total += widths[i] + kGap;
  }
  while (style.width > 0 && total > style.width) {
    const auto spare = [this](std::size_t i) { return columns_[i].spare; };
    const auto first = std::ranges::max_element(shown, {}, spare);
    if (columns_[*first].spare == 0) break;
    total -= widths[*first] + kGap;
    shown.erase(first);
  }
  return shown;
}

std::string Table::Text(const Style& style, std::size_t most, const std::string& more) const {
  std::vector<int> widths;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    int width = Width(columns_[i].header);
    for (const auto& row : rows_) width = std::max(width, Width(row[i].text));
    widths.push_back(width);
  }
  const std::vector<std::size_t> shown = ShownColumns(widths, style);
  const auto line = [&](auto cell) {
    std::string text;
    for (const std::size_t i : shown) {
      if (!text.empty()) text += std::string(kGap, ' ');
      const auto& [words, tone] = cell(i);
      text += Paint(Pad(words, columns_[i].right ? -widths[i] : widths[i]), tone, style);
    }
    return TrimRight(std::move(text)) + "\n";
  };

  std::string text = line([&](std::size_t i) { return Cell(columns_[i].header, Tone::kFaint); });
  const std::size_t head = most == 0 || rows_.size() <= most ? rows_.size() : most / 2;
  const std::size_t tail = head == rows_.size() ? rows_.size() : rows_.size() - (most - head);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (r == head) {
      text += Paint(fmt::format(fmt::runtime(more), tail - head), Tone::kFaint, style) + "\n";
      r = tail;
    }
    text += line([&](std::size_t i) { return rows_[r][i]; });
  }
  return text;
}

}  // namespace contact::cli
