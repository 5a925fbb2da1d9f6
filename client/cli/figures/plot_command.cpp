#include "cli/figures/plot_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "cli/figures/curve_style.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostKeys = 10;  // Above it, dashed curves have one entry together.

// What a panel has in its key beside its curves: gnuplot's style and the text.
using KeyEntries = std::vector<std::pair<std::string, std::string>>;

std::string StyleOf(const Figure::Curve& curve, const GnuplotTerminal& terminal) {
  if (terminal.characters()) return CharacterStyle(curve);
  return terminal.style().paper ? PaperStyle(curve) : ColouredStyle(curve);
}

bool IsNamed(const Figure::Curve& curve) { return curve.keyed && !curve.label.empty(); }

bool IsKeyFull(const Figure::Panel& panel) {
  return std::ranges::count_if(panel.curves, IsNamed) > static_cast<std::ptrdiff_t>(kMostKeys);
}

// What faint curves, bands and, among many others, dashed curves are.
KeyEntries EntriesBeside(const Figure::Panel& panel, std::size_t crowd,
                         const GnuplotTerminal& terminal) {
  constexpr int kBlack = 6;
  KeyEntries entries;
  const bool characters = terminal.characters();
  const auto faint = std::ranges::find_if(panel.curves, IsFaint);
  const bool named = std::ranges::any_of(panel.curves, IsNamed);
  if (crowd > 0 && named && faint != panel.curves.end()) {
    entries.emplace_back(characters ? "points pt ' '" : StyleOf(*faint, terminal),
                         fmt::format("{} smaller{}", crowd, characters ? ": not shown" : ""));
  }
  if (!panel.dashed.empty() && IsKeyFull(panel)) {
    const Figure::Curve dashed{.colour = kBlack, .mark = Figure::Mark::kDashed};
    entries.emplace_back(StyleOf(dashed, terminal), panel.dashed);
  }
  if (!panel.bands.empty() && !panel.band_label.empty() && !characters) {
    entries.emplace_back(
        fmt::format("boxes fillstyle solid noborder fillcolor rgb '{}'", kBandShade),
        panel.band_label);
  }
  return entries;
}

}  // namespace

std::string PlotCommand(const Figure::Panel& panel, std::size_t before, std::size_t crowd,
                        const GnuplotTerminal& terminal) {
  const bool full = IsKeyFull(panel);
  std::size_t longest = 0;  // Text in the key.
  const auto title = [&](const std::string& text) {
    longest = std::max(longest, text.size());
    return "title " + terminal.Text(text);
  };
  std::vector<std::string> faint, others;  // Faint curves lie behind the others.
  for (const Figure::Curve& curve : panel.curves) {
    ++before;
    if (IsFaint(curve) && terminal.characters()) continue;
    const bool listed = IsNamed(curve) && !(full && curve.mark == Figure::Mark::kDashed);
    (IsFaint(curve) ? faint : others)
        .push_back(fmt::format("$curve{} using ($1/x_unit):($2/y_unit) with {} {}", before,
                               StyleOf(curve, terminal), listed ? title(curve.label) : "notitle"));
  }
  for (const auto& [style, text] : EntriesBeside(panel, crowd, terminal)) {
    others.push_back(fmt::format("keyentry with {} {}", style, title(text)));
  }
  faint.insert(faint.end(), others.begin(), others.end());
  return fmt::format("set key maxcols {}\nplot {}\n", terminal.KeyColumns(longest),
                     fmt::join(faint, ", \\\n     "));
}

}  // namespace contact::cli
