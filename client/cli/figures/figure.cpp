#include "cli/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "cli/base/csv.h"

namespace contact::cli {
namespace {

// Of the points in [begin, end), those that Thin keeps, in order.
void AddOutline(const Figure::Curve& curve, std::size_t begin, std::size_t end,
                Figure::Curve* thinned) {
  const auto y = curve.y.begin();
  const auto first = static_cast<std::ptrdiff_t>(begin);
  const auto last = static_cast<std::ptrdiff_t>(end);
  const auto [low, high] = std::minmax_element(y + first, y + last);
  std::array<std::ptrdiff_t, 4> kept{first, low - y, high - y, last - 1};
  std::ranges::sort(kept);
  const auto same = std::unique(kept.begin(), kept.end());
  for (auto i = kept.begin(); i != same; ++i) {
    thinned->x.push_back(curve.x[static_cast<std::size_t>(*i)]);
    thinned->y.push_back(curve.y[static_cast<std::size_t>(*i)]);
  }
}

std::string_view Name(Figure::Mark mark) {
  if (mark == Figure::Mark::kStart) return " starts";
  return mark == Figure::Mark::kEnd ? " ends" : "";
}

}  // namespace

void Thin(std::size_t points, Figure* figure) {
  const std::size_t parts = std::max<std::size_t>(points / 4, 1);
  for (Figure::Panel& panel : figure->panels) {
    for (Figure::Curve& curve : panel.curves) {
      const std::size_t size = curve.x.size();
      if (size <= points) continue;
      Figure::Curve thinned{curve.label, curve.colour, curve.mark, {}, {}};
      for (std::size_t i = 0; i < parts; ++i) {
        AddOutline(curve, size * i / parts, size * (i + 1) / parts, &thinned);
      }
      curve = std::move(thinned);
    }
  }
}

std::string FigureCsv(const Figure& figure) {
  std::string text;
  CsvWriter csv(&text);
  for (const Figure::Panel& panel : figure.panels) {
    csv.Row({"curve", panel.x_label, panel.y_label});
    for (const Figure::Curve& curve : panel.curves) {
      const std::string name = fmt::format("{}{}", curve.label, Name(curve.mark));
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        csv.Add(name).Add(curve.x[i]).Add(curve.y[i]).EndRow();
      }
    }
  }
  return text;
}

}  // namespace contact::cli
