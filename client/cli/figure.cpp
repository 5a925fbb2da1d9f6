#include "cli/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "cli/gnuplot.h"

namespace contact::cli {
namespace {

// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kDashes{1, 4, 5};       // For colours that come again.
constexpr std::size_t kMostLevelLabels = 4;  // More are written upright.
constexpr std::size_t kMostCounted = 20;     // Whole numbers that an axis can name.
constexpr std::size_t kMostKeys = 8;         // Beyond them dashed curves are not in the key.
constexpr std::size_t kMostPoints = 4000;    // Of a curve, which is five a pixel.

constexpr char kMarksExplained[] =
    "set label 'o start, × end of a contact cycle' at screen 0.01,0.015 left font ',7' "
    "textcolor rgb '#666666'";

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

std::string_view Colour(int colour) {
  return kColours[static_cast<std::size_t>(colour) % kColours.size()];
}

std::string Style(Figure::Mark mark, int colour) {
  switch (mark) {
    case Figure::Mark::kLine:
      return fmt::format("lines lw 1.5 dt {}",
                         kDashes[static_cast<std::size_t>(colour) / kColours.size() % 3]);
    case Figure::Mark::kDashed:
      return "lines lw 1.5 dt 2";
    case Figure::Mark::kDotted:
      return "lines lw 1.5 dt 3";
    case Figure::Mark::kStart:
      return "points pt 6";
    case Figure::Mark::kEnd:
      return "points pt 2";
    case Figure::Mark::kLinePoints:
      return "linespoints lw 1.5 pt 6";
  }
  return "lines";
}

// gnuplot's words for an axis that all points fit: `*` where it finds the limit itself.
std::string Range(const Figure::Panel& panel, std::vector<double> Figure::Curve::*axis,
                  bool counted, bool log) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Figure::Curve& curve : panel.curves) {
    for (const double value : curve.*axis) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (counted) return fmt::format("[{}:{}]", low - 0.5, high + 0.5);
  if (low < high) return "[*:*] noextend";
  if (log) return fmt::format("[{}:{}]", low / 10, high * 10);
  const double space = low == 0 ? 1 : std::abs(low) / 2;  // Of one value alone.
  return fmt::format("[{}:{}]", low - space, low + space);
}

bool HasUnnamedMarks(const Figure::Panel& panel) {
  bool marked = false;
  for (const Figure::Curve& curve : panel.curves) {
    if (curve.mark != Figure::Mark::kStart && curve.mark != Figure::Mark::kEnd) continue;
    if (!curve.label.empty()) return false;
    marked = true;
  }
  return marked;
}

// Bands of many contacts lie over each other, and must not hide the curves.
double BandOpacity(const Figure::Panel& panel) {
  std::set<int> contacts;
  for (const Figure::Band& band : panel.bands) contacts.insert(band.colour);
  return std::min(0.12, 0.4 / static_cast<double>(contacts.size()));
}

// Writes a script piece by piece.
class Script {
 public:
  std::string Write(const Figure& figure, std::string_view format, const std::string& path) {
    text_ += Lines(figure.sources, "# ");
    Line("set encoding utf8");
    Line("set terminal {}", GnuplotTerminal(format, figure.panels.size() > 1 ? 7 : 5));
    Line("set output {}", GnuplotString(path));
    for (const Figure::Panel& panel : figure.panels) Data(panel);
    Line("set grid lc rgb '#dddddd' lt 1");
    Line("set key tmargin center horizontal font ',10'");
    Line("set offsets graph 0.02, graph 0.02, graph 0.08, graph 0.03");
    if (figure.panels.size() > 1) Line("set lmargin at screen 0.15");  // Axes below each other.
    Line("set multiplot layout {},1 title {}.\"\\n\"", figure.panels.size(),
         GnuplotString(figure.title));
    for (const Figure::Panel& panel : figure.panels) {
      if (&panel == &figure.panels.back()) {
        text_ += GnuplotCaption(figure.sources);
        if (HasUnnamedMarks(panel)) Line("{}", kMarksExplained);
      }
      Draw(panel);
    }
    Line("unset multiplot");
    Line("unset output");
    return std::move(text_);
  }

 private:
  template <class... Arguments>
  void Line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void Data(const Figure::Panel& panel) {
    for (const Figure::Curve& curve : panel.curves) {
      Line("$curve{} << end", ++written_);
      for (std::size_t i = 0; i < curve.x.size(); ++i) Line("{} {}", curve.x[i], curve.y[i]);
      Line("end");
    }
  }

  void Draw(const Figure::Panel& panel) {
    Line("set xlabel {}", GnuplotString(panel.x_label));
    Line("set ylabel {}", GnuplotString(panel.y_label));
    Line("{} logscale y", panel.log_y ? "set" : "unset");
    Line("{}", panel.log_y ? "set format y '%.0e'" : "set format y '%g'");
    Line("set xtics {}", panel.counted_x && Longest(panel) <= kMostCounted ? "1" : "autofreq");
    Line("set xrange {}", Range(panel, &Figure::Curve::x, panel.counted_x, false));
    Line("set yrange {}", Range(panel, &Figure::Curve::y, false, panel.log_y));
    if (panel.lowest_y) Line("set yrange [{}:*]", *panel.lowest_y);
    for (const Figure::Band& band : panel.bands) {
      Line(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '{}' fillstyle transparent solid {:.2g} noborder",
          band.start, band.end, Colour(band.colour), BandOpacity(panel));
    }
    for (const Figure::Label& label : panel.labels) {
      Line("set label {} at {},{} {} font ',9'", GnuplotString(label.text), label.x, label.y,
           panel.labels.size() > kMostLevelLabels ? "left rotate by 90 offset 0,0.4"
                                                  : "center offset 0,0.6");
    }
    if (panel.labels.size() > kMostLevelLabels)
      Line("set offsets graph 0.02, graph 0.02, graph 0.55, graph 0.03");
    for (const double y : panel.dotted_lines) {
      Line(
          "set arrow from graph 0, first {0} to graph 1, first {0} nohead front lc rgb '#444444' "
          "lw 1.5 dt 3",
          y);
    }
    Curves(panel);
    Line("unset object\nunset label\nunset arrow");
  }

  void Curves(const Figure::Panel& panel) {
    const bool few = std::ranges::count(panel.curves, false, [](const Figure::Curve& curve) {
                       return curve.label.empty();
                     }) <= std::ptrdiff_t{kMostKeys};
    std::string_view separator = "plot ";
    for (const Figure::Curve& curve : panel.curves) {
      text_ += fmt::format("{}$curve{} with {} lc rgb '{}' ", separator, ++drawn_,
                           Style(curve.mark, curve.colour), Colour(curve.colour));
      const bool keyed = !curve.label.empty() && (few || curve.mark != Figure::Mark::kDashed);
      text_ += keyed ? "title " + GnuplotString(curve.label) : "notitle";
      separator = ", \\\n     ";
    }
    text_ += '\n';
  }

  std::string text_;
  int written_ = 0;
  int drawn_ = 0;
};

// Of the points in [begin, end), those that Thin keeps, in order.
void AddOutline(const Figure::Curve& curve, std::size_t begin, std::size_t end,
                Figure::Curve* thinned) {
  const auto y = curve.y.begin();
  const auto first = static_cast<std::ptrdiff_t>(begin);
  const auto last = static_cast<std::ptrdiff_t>(end);
  const auto [low, high] = std::minmax_element(y + first, y + last);
  std::array<std::ptrdiff_t, 4> kept{first, low - y, high - y, last - 1};
  std::ranges::sort(kept);
  const auto same = std::ranges::unique(kept);
  for (auto i = kept.begin(); i != same.begin(); ++i) {
    thinned->x.push_back(curve.x[static_cast<std::size_t>(*i)]);
    thinned->y.push_back(curve.y[static_cast<std::size_t>(*i)]);
  }
}

std::string_view Name(Figure::Mark mark) {
  if (mark == Figure::Mark::kStart) return " starts";
  return mark == Figure::Mark::kEnd ? " ends" : "";
}

}  // namespace

std::string GnuplotScript(Figure figure, std::string_view format, const std::string& path) {
  Thin(kMostPoints, &figure);
  return Script().Write(figure, format, path);
}

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

void WriteCsv(const Figure& figure, std::FILE* file) {
  for (const Figure::Panel& panel : figure.panels) {
    fmt::print(file, "curve,{},{}\n", panel.x_label, panel.y_label);
    for (const Figure::Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        fmt::print(file, "{}{},{},{}\n", curve.label, Name(curve.mark), curve.x[i], curve.y[i]);
      }
    }
  }
}

}  // namespace contact::cli
