#include "cli/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "cli/gnuplot.h"

namespace contact::cli {
namespace {

// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
constexpr std::size_t kMostLevelLabels = 4;  // More are written upright.

constexpr std::size_t kMostCounted = 20;  // Whole numbers that an axis can name.

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

std::string_view Colour(int colour) { return kColours[static_cast<std::size_t>(colour) % 7]; }

std::string_view Style(Figure::Mark mark) {
  switch (mark) {
    case Figure::Mark::kLine:
      return "lines lw 1.5";
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

std::string Terminal(std::string_view format, std::size_t panels) {
  const double height = panels > 1 ? 7 : 5;  // inches; 100 pixels each
  if (format == "pdf") {
    return fmt::format("pdfcairo noenhanced color size 8in,{}in font 'Sans,11'", height);
  }
  return fmt::format("{} noenhanced size 800,{} background '#ffffff' font 'Sans,12'",
                     format == "png" ? "pngcairo" : "svg", height * 100);
}

// gnuplot's words for an axis that all points fit: `*` where it finds the limit itself.
std::string Range(const Figure::Panel& panel, std::vector<double> Figure::Curve::*axis,
                  bool counted) {
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
  const double space = low == 0 ? 1 : std::abs(low) / 2;  // Of one value alone.
  return fmt::format("[{}:{}]", low - space, low + space);
}

// Writes a script piece by piece.
class Script {
 public:
  std::string Write(const Figure& figure, std::string_view format, const std::string& path) {
    text_ += Lines(figure.sources, "# ");
    Line("set encoding utf8");
    Line("set terminal {}", Terminal(format, figure.panels.size()));
    Line("set output {}", GnuplotString(path));
    for (const Figure::Panel& panel : figure.panels) Data(panel);
    Line("set grid lc rgb '#dddddd' lt 1");
    Line("set key tmargin center horizontal font ',10'");
    Line("set offsets graph 0.02, graph 0.02, graph 0.08, graph 0.03");
    if (figure.panels.size() > 1) Line("set lmargin at screen 0.15");  // Axes below each other.
    Line("set multiplot layout {},1 title {}.\"\\n\"", figure.panels.size(),
         GnuplotString(figure.title));
    for (const Figure::Panel& panel : figure.panels) {
      if (&panel == &figure.panels.back()) text_ += GnuplotCaption(figure.sources);
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
    Line("set xrange {}", Range(panel, &Figure::Curve::x, panel.counted_x));
    Line("set yrange {}", Range(panel, &Figure::Curve::y, false));
    if (panel.lowest_y) Line("set yrange [{}:*]", *panel.lowest_y);
    for (const Figure::Band& band : panel.bands) {
      Line(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '{}' fillstyle transparent solid 0.12 noborder",
          band.start, band.end, Colour(band.colour));
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
    std::string_view separator = "plot ";
    for (const Figure::Curve& curve : panel.curves) {
      text_ += fmt::format("{}$curve{} with {} lc rgb '{}' ", separator, ++drawn_,
                           Style(curve.mark), Colour(curve.colour));
      text_ += curve.label.empty() ? "notitle" : "title " + GnuplotString(curve.label);
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

std::string GnuplotScript(const Figure& figure, std::string_view format, const std::string& path) {
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
