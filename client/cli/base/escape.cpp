#include "cli/base/escape.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/spelling.h"

namespace contact::cli {
namespace {

using Escape = std::pair<std::string_view, std::string_view>;

constexpr Escape kLatex[] = {
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"\\", "\\textbackslash{}"},
    {"^", "\\textasciicircum{}"},
    {"~", "\\textasciitilde{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"μ", "$\\mu$"},
    {"µ", "$\\mu$"},  // The sign of micro.
    {"ε", "$\\varepsilon$"},
    {"δ", "$\\delta$"},
    {"α", "$\\alpha$"},
    {"Δ", "$\\Delta$"},
    {"²", "$^2$"},
    {"×", "$\\times$"},
    {"−", "$-$"},
};

std::string Escaped(std::string_view text, std::span<const Escape> escapes) {
  std::string escaped;
  while (!text.empty()) {
    const std::size_t unprintable = text.front() == '\n' ? 0 : UnprintableBytes(text);
    if (unprintable > 0) {
      escaped += ' ';
      text.remove_prefix(unprintable);
      continue;
    }
    const auto begins = [text](const Escape& escape) { return text.starts_with(escape.first); };
    const auto found = std::ranges::find_if(escapes, begins);
    const auto [plain, shown] =
        found == escapes.end() ? Escape(text.substr(0, 1), text.substr(0, 1)) : *found;
    escaped += shown;
    text.remove_prefix(plain.size());
  }
  return escaped;
}

}  // namespace

std::string LatexText(std::string_view text) { return Escaped(text, kLatex); }

}  // namespace contact::cli
