#include "cli/figures/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "cli/figures/curve_style.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostLevelLabels = 4;  // More labels are written upright.
constexpr std::size_t kMostCounted = 20;     // Above it, not every whole number has a tic.
constexpr std::ptrdiff_t kMostKeys = 8;      // Above it, dashed curves are not in the key.

constexpr char kMarksExplained[] = "o start, × end of a contact cycle";

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

// The least and the largest number of an axis; the first is above the second without numbers.
std::pair<double, double> Extent(const Figure::Panel& panel,
                                 std::vector<double> Figure::Curve::*axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Figure::Curve& curve : panel.curves) {
    for (const double value : curve.*axis) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return {low, high};
}

// The range of an axis that holds all points; `*` leaves a limit to gnuplot, which fails where all
// points have the same value.
std::string Range(const Figure::Panel& panel, std::vector<double> Figure::Curve::*axis,
                  bool counted, bool log) {
  const auto [low, high] = Extent(panel, axis);
  if (counted) return fmt::format("[{}:{}]", low - 0.5, high + 0.5);
  if (low < high) return "[*:*] noextend";
  if (log) return fmt::format("[{}:{}]", low / 10, high * 10);
  const double space = low == 0 ? 1 : std::abs(low) / 2;
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

// Writes a script piece by piece, in the order of the methods below Write.
class Script {
 public:
  explicit Script(GnuplotTerminal terminal) : terminal_(std::move(terminal)) {}

  std::string Write(const Figure& figure, const std::string& path) {
    text_ += Lines(figure.sources, "# ");
    Output(figure, path);
    for (const Figure::Panel& panel : figure.panels) Data(panel);
    Layout(figure);
    for (const Figure::Panel& panel : figure.panels) {
      if (&panel == &figure.panels.back()) Below(figure);
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

  void Output(const Figure& figure, const std::string& path) {
    Line("set encoding utf8");
    Line("set terminal {}", terminal_.Terminal(figure.panels.size() > 1 ? 7 : 5));
    Line("set output {}", GnuplotString(path));
  }

  void Data(const Figure::Panel& panel) {
    for (const Figure::Curve& curve : panel.curves) {
      Line("$curve{} << end", ++written_);
      for (std::size_t i = 0; i < curve.x.size(); ++i) Line("{} {}", curve.x[i], curve.y[i]);
      Line("end");
    }
  }

  // Grid, key, margins and title, which all panels share.
  void Layout(const Figure& figure) {
    const bool characters = terminal_.characters();
    if (!characters) Line("set grid lc rgb '#dddddd' lt 1");
    const char* spread = characters || terminal_.tex() ? " width 1" : "";  // Between entries.
    Line("set key tmargin center horizontal{}{}", terminal_.Font(10), spread);
    Offsets(characters ? 0.2 : 0.08);
    if (figure.panels.size() > 1 && !characters) {
      Line("set lmargin at screen 0.15");  // The y axes stand below each other.
    }
    Line("set multiplot layout {},1 title {}{}", figure.panels.size(), terminal_.Text(figure.title),
         characters ? "" : ".\"\\n\"");
  }

  // Free space around the points, the upper part for labels.
  void Offsets(double above) {
    Line("set offsets graph 0.02, graph 0.02, graph {}, graph 0.03", above);
  }

  // What stands below the last panel.
  void Below(const Figure& figure) {
    text_ += terminal_.CaptionCommands(figure.sources);
    if (!HasUnnamedMarks(figure.panels.back())) return;
    Line("set label {} at screen 0.01,0.015 left{} textcolor rgb '#666666'",
         terminal_.Text(kMarksExplained), terminal_.Font(7));
  }

  void Draw(const Figure::Panel& panel) {
    AxisLabels(panel);
    AxisRanges(panel);
    if (!terminal_.characters()) Bands(panel);
    Labels(panel);
    DottedLines(panel);
    Curves(panel);
    Line("unset object\nunset label\nunset arrow");
  }

  // Characters cannot stand upright: there the label of y is a part of the upper border.
  void AxisLabels(const Figure::Panel& panel) {
    Line("set xlabel {}", terminal_.Text(panel.x_label));
    if (terminal_.characters()) {
      Line("set label {} at graph 0.02, graph 1 left front",
           terminal_.Text(fmt::format(" {} ", panel.y_label)));
    } else {
      Line("set ylabel {}", terminal_.Text(panel.y_label));
    }
  }

  void AxisRanges(const Figure::Panel& panel) {
    Line("{} logscale y", panel.log_y ? "set" : "unset");
    Line("{}", panel.log_y ? "set format y '%.0e'" : "set format y '%g'");
    Line("set xtics {}", panel.counted_x && Longest(panel) <= kMostCounted ? "1" : "autofreq");
    Line("set xrange {}", Range(panel, &Figure::Curve::x, panel.counted_x, false));
    Line("set yrange {}", Range(panel, &Figure::Curve::y, false, panel.log_y));
    if (panel.lowest_y) Line("set yrange [{}:*]", *panel.lowest_y);
  }

  void Bands(const Figure::Panel& panel) {
    for (const Figure::Band& band : panel.bands) {
      Line(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '{}' fillstyle transparent solid {:.2g} noborder",
          band.start, band.end, PaletteColour(band.colour), BandOpacity(panel));
    }
  }

  // Many labels are upright, which leaves none of them in characters.
  void Labels(const Figure::Panel& panel) {
    const bool many = panel.labels.size() > kMostLevelLabels;
    if (many && terminal_.characters()) return;
    for (const Figure::Label& label : panel.labels) {
      Line("set label {} at {},{} {}{}", terminal_.Text(label.text), label.x, label.y,
           terminal_.characters() ? "center front offset 0,1"
           : many                 ? "left rotate by 90 offset 0,0.4"
                                  : "center offset 0,0.6",
           terminal_.Font(9));
    }
    if (many) Offsets(0.55);
  }

  void DottedLines(const Figure::Panel& panel) {
    for (const double y : panel.dotted_lines) {
      Line(
          "set arrow from graph 0, first {0} to graph 1, first {0} nohead front lc rgb '#444444' "
          "lw 1.5 dt 3",
          y);
    }
  }

  void Curves(const Figure::Panel& panel) {
    const bool few = std::ranges::count_if(panel.curves, [](const Figure::Curve& curve) {
                       return !curve.label.empty();
                     }) <= kMostKeys;
    std::string_view separator = "plot ";
    for (const Figure::Curve& curve : panel.curves) {
      text_ += fmt::format("{}$curve{} with {} ", separator, ++drawn_,
                           terminal_.characters() ? CharacterStyle(curve) : ColouredStyle(curve));
      const bool keyed = !curve.label.empty() && (few || curve.mark != Figure::Mark::kDashed);
      text_ += keyed ? "title " + terminal_.Text(curve.label) : "notitle";
      separator = ", \\\n     ";
    }
    text_ += '\n';
  }

  const GnuplotTerminal terminal_;
  std::string text_;
  int written_ = 0;  // Data blocks that the script has.
  int drawn_ = 0;    // Data blocks that are drawn.
};

}  // namespace

std::string GnuplotScript(Figure figure, const GnuplotTerminal& terminal, const std::string& path) {
  constexpr std::size_t kMostPoints = 4000;  // Of a curve: about five for each pixel of its width.
  Thin(kMostPoints, &figure);
  return Script(terminal).Write(figure, path);
}

}  // namespace contact::cli
