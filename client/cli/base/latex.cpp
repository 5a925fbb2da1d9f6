#include "cli/base/latex.h"

#include <cstddef>
#include <utility>

namespace contact::cli {
namespace {

constexpr std::pair<std::string_view, std::string_view> kWords[] = {
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
    {"ε", "$\\varepsilon$"},
    {"δ", "$\\delta$"},
    {"α", "$\\alpha$"},
    {"Δ", "$\\Delta$"},
    {"²", "$^2$"},
    {"×", "$\\times$"},
    {"−", "$-$"},
};

// What stands for the beginning of the text; null if that is set as it is.
const std::pair<std::string_view, std::string_view>* Word(std::string_view text) {
  for (const auto& word : kWords) {
    if (text.starts_with(word.first)) return &word;
  }
  return nullptr;
}

}  // namespace

std::string LatexText(std::string_view text) {
  std::string set;
  while (!text.empty()) {
    const auto* word = Word(text);
    set += word == nullptr ? text.substr(0, 1) : word->second;
    text.remove_prefix(word == nullptr ? 1 : word->first.size());
  }
  return set;
}

}  // namespace contact::cli
