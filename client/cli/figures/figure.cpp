#include "cli/figures/figure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
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

// How large a curve is, for KeepLargest.
double SizeOf(const Figure::Curve& curve, bool by_span) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double y : curve.y) {
    if (std::isnan(y)) continue;
    low = std::min(low, y);
    high = std::max(high, y);
  }
  if (!(low <= high)) return 0;
  return by_span ? high - low : std::max(-low, high);
}

// The size of the largest curve of each colour in a panel, the largest of all being 1.
std::map<int, double> SizesIn(const Figure::Panel& panel) {
  std::map<int, double> sizes;
  double largest = 0;
  for (const Figure::Curve& curve : panel.curves) {
    double& size = sizes[curve.colour];
    size = std::max(size, SizeOf(curve, panel.ranked_by_span));
    largest = std::max(largest, size);
  }
  for (auto& [colour, size] : sizes) size = largest > 0 ? size / largest : 0;
  return sizes;
}

// The colours of a figure, that of the largest curve first; of equal ones the first in the figure.
std::vector<int> BySize(const Figure& figure) {
  std::map<int, double> sizes;
  for (const Figure::Panel& panel : figure.panels) {
    for (const auto& [colour, size] : SizesIn(panel)) sizes[colour] = size;
  }
  std::vector<int> colours;
  for (const auto& [colour, size] : sizes) colours.push_back(colour);
  std::ranges::stable_sort(colours, std::greater(), [&](int colour) { return sizes[colour]; });
  return colours;
}

bool IsMark(const Figure::Curve& curve) {
  return curve.mark == Figure::Mark::kStart || curve.mark == Figure::Mark::kEnd;
}

// Makes curves of other colours faint, without the marks on them and what is dashed beside them.
void Fade(Figure::Panel* panel, const std::map<int, int>& kept) {
  const bool lines = !std::ranges::all_of(panel->curves, IsMark);
  std::erase_if(panel->curves, [&](const Figure::Curve& curve) {
    const bool beside = (IsMark(curve) && lines) || curve.mark == Figure::Mark::kDashed;
    return beside && !kept.contains(curve.colour);
  });
  for (Figure::Curve& curve : panel->curves) {
    if (const auto place = kept.find(curve.colour); place != kept.end()) {
      curve.colour = place->second;
    } else {
      curve.mark = IsMark(curve) ? Figure::Mark::kFaintDots : Figure::Mark::kFaint;
      curve.keyed = false;
    }
  }
}

}  // namespace

void Thin(std::size_t points, Figure* figure) {
  const std::size_t parts = std::max<std::size_t>(points / 4, 1);
  for (Figure::Panel& panel : figure->panels) {
    for (Figure::Curve& curve : panel.curves) {
      const std::size_t size = curve.x.size();
      if (size <= points) continue;
      Figure::Curve thinned{curve.label, curve.colour, curve.mark, {}, {}, curve.keyed};
      for (std::size_t i = 0; i < parts; ++i) {
        AddOutline(curve, size * i / parts, size * (i + 1) / parts, &thinned);
      }
      curve = std::move(thinned);
    }
  }
}

void KeepLargest(Figure* figure) {
  std::vector<int> largest = BySize(*figure);
  if (largest.size() <= figure->most_colours) return;
  figure->crowd = largest.size() - figure->most_colours;
  largest.resize(figure->most_colours);
  std::ranges::sort(largest);
  std::map<int, int> kept;  // Their places in the palette.
  for (const int colour : largest) kept.emplace(colour, static_cast<int>(kept.size()));
  for (Figure::Panel& panel : figure->panels) Fade(&panel, kept);
}

std::string FigureCsv(const Figure& figure) {
  std::string text;
  CsvWriter csv(&text);
  for (const Figure::Panel& panel : figure.panels) {
    csv.Row({"curve", panel.x_label, panel.y_label});
    for (const Figure::Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        csv.Add(curve.label).Add(curve.x[i]).Add(curve.y[i]).EndRow();
      }
    }
  }
  return text;
}

}  // namespace contact::cli
