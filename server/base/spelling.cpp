#include "base/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace contact {
namespace {

constexpr std::size_t kLongest = 64;

// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

// Without what parts words: `three-ball` is `threeball`.
std::string Letters(std::string_view name) {
  std::string letters(name);
  std::erase_if(letters, [](char c) { return c == '-' || c == '_'; });
  return letters;
}

// Characters of UTF-8 that are not printable: a prefix and the range of the byte after it.
struct Unprintable {
  std::string_view prefix;
  unsigned char low, high;
};
constexpr Unprintable kUnprintable[] = {
    {"", 0x00, 0x1F},          // C0
    {"", 0x7F, 0x7F},          // Delete
    {"\xC2", 0x80, 0x9F},      // C1
    {"\xD8", 0x9C, 0x9C},      // U+061C, a mark of direction
    {"\xE2\x80", 0x8E, 0x8F},  // U+200E and U+200F, marks of direction
    {"\xE2\x80", 0xA8, 0xAE},  // U+2028 to U+202E: separators, embeddings, overrides
    {"\xE2\x81", 0xA6, 0xA9},  // U+2066 to U+2069: isolates
};

// The text with `instead` for each unprintable character that is none of those kept.
std::string Replaced(std::string_view text, char instead, std::string_view kept) {
  std::string printable;
  printable.reserve(text.size());
  while (!text.empty()) {
    const bool keep = kept.find(text.front()) != std::string_view::npos;
    const std::size_t bytes = keep ? 0 : UnprintableBytes(text);
    printable += bytes > 0 ? instead : text.front();
    text.remove_prefix(std::max<std::size_t>(1, bytes));
  }
  return printable;
}

bool IsContinuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

std::string_view Nearest(std::string_view name, const std::vector<std::string_view>& candidates) {
  // A limit on both lengths keeps hostile names cheap.
  if (name.empty() || name.size() > kLongest) return {};
  std::string_view nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  const std::string letters = Letters(name);
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongest) continue;
    const bool begins = letters.size() >= 3 && Letters(candidate).starts_with(letters);
    const std::size_t distance = begins ? 1 : EditDistance(name, candidate);
    if (distance >= least || 2 * distance > std::max(name.size(), candidate.size())) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string DidYouMean(std::string_view name, const std::vector<std::string_view>& candidates,
                       const std::string& otherwise) {
  const std::string_view nearest = Nearest(name, candidates);
  return nearest.empty() ? otherwise : fmt::format("did you mean '{}'?", nearest);
}

std::string WithHint(const std::string& message, const std::string& hint) {
  return hint.empty() ? message : message + " — " + hint;
}

std::string Count(std::int64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string Shortened(std::string_view text) {
  const bool cut = text.size() > kLongest;
  std::size_t size = std::min(text.size(), kLongest);
  while (cut && size > 0 && IsContinuation(text[size])) --size;
  return Printable(text.substr(0, size)) + (cut ? "…" : "");
}

std::string Quoted(std::string_view text) { return fmt::format("'{}'", Shortened(text)); }

std::size_t UnprintableBytes(std::string_view text) {
  for (const auto& [prefix, low, high] : kUnprintable) {
    if (text.size() <= prefix.size() || !text.starts_with(prefix)) continue;
    const auto byte = static_cast<unsigned char>(text[prefix.size()]);
    if (byte >= low && byte <= high) return prefix.size() + 1;
  }
  return 0;
}

std::string Printable(std::string_view text, char instead) { return Replaced(text, instead, ""); }

std::string PrintableLines(std::string_view text) { return Replaced(text, '?', "\n\t"); }

}  // namespace contact
