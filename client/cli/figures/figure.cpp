#include "cli/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "cli/base/csv.h"

namespace contact::cli {
namespace {

// Of the points in [begin, end), those that Thin keeps, in order.
void AddOutline(const Figure::Curve& curve, std::size_t begin, std::size_t end,
                Figure::Curve* thinned) {
  const auto at = [&](std::size_t i) { return curve.y.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto [low, high] = std::minmax_element(at(begin), at(end));
  for (const auto kept : std::set{at(begin), low, high, at(end - 1)}) {
    thinned->x.push_back(curve.x[static_cast<std::size_t>(kept - curve.y.begin())]);
    thinned->y.push_back(*kept);
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
