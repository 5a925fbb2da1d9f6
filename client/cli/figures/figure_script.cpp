#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "cli/figures/figure.h"
#include "cli/figures/gnuplot.h"

namespace contact::cli {
namespace {

// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kDashes{1, 4, 5};       // For colours that come again.
constexpr std::size_t kMostLevelLabels = 4;  // More are written upright.
constexpr std::size_t kMostCounted = 20;     // Whole numbers that an axis can name.
constexpr std::size_t kMostKeys = 8;         // Beyond them dashed curves are not in the key.

constexpr char kMarksExplained[] = "o start, × end of a contact cycle";

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

std::string_view Colour(int colour) {
  return kColours[static_cast<std::size_t>(colour) % kColours.size()];
}

std::string InColour(const Figure::Curve& curve) {
  const auto colour = static_cast<std::size_t>(curve.colour);
  const std::string ending = fmt::format(" lc rgb '{}'", Colour(curve.colour));
  switch (curve.mark) {
    case Figure::Mark::kLine:
      return fmt::format("lines lw 1.5 dt {}{}", kDashes[colour / kColours.size() % 3], ending);
    case Figure::Mark::kDashed:
      return "lines lw 1.5 dt 2" + ending;
    case Figure::Mark::kDotted:
      return "lines lw 1.5 dt 3" + ending;
    case Figure::Mark::kStart:
      return "points pt 6" + ending;
    case Figure::Mark::kEnd:
      return "points pt 2" + ending;
    case Figure::Mark::kLinePoints:
      return "linespoints lw 1.5 pt 6" + ending;
  }
  return "lines" + ending;
}

// Colours and dashes are characters, which a line type chooses.
std::string InCharacters(const Figure::Curve& curve) {
  constexpr int kCharacters = 7;  // * # $ % @ & =
  constexpr int kOfDashed = 3;    // So far from that of the solid curve.
  const bool dashed = curve.mark == Figure::Mark::kDashed || curve.mark == Figure::Mark::kDotted;
  const int type = (curve.colour + (dashed ? kOfDashed : 0)) % kCharacters + 1;
  if (curve.mark == Figure::Mark::kStart) return fmt::format("points pt 'o' lt {}", type);
  if (curve.mark == Figure::Mark::kEnd) return fmt::format("points pt '×' lt {}", type);
  if (curve.mark == Figure::Mark::kLinePoints) return fmt::format("linespoints pt 'o' lt {}", type);
  return fmt::format("lines lt {}", type);
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
  explicit Script(Medium medium) : medium_(std::move(medium)) {}

  std::string Write(const Figure& figure, const std::string& path) {
    text_ += Lines(figure.sources, "# ");
    Line("set encoding utf8");
    Line("set terminal {}", medium_.Terminal(figure.panels.size() > 1 ? 7 : 5));
    Line("set output {}", GnuplotString(path));
    for (const Figure::Panel& panel : figure.panels) Data(panel);
    if (!medium_.characters()) Line("set grid lc rgb '#dddddd' lt 1");
    Line("set key tmargin center horizontal{}{}", medium_.Font(10), Spread());
    Offsets(medium_.characters() ? 0.2 : 0.08);
    if (figure.panels.size() > 1 && !medium_.characters()) {
      Line("set lmargin at screen 0.15");  // Axes below each other.
    }
    Line("set multiplot layout {},1 title {}{}", figure.panels.size(), medium_.Text(figure.title),
         medium_.characters() ? "" : ".\"\\n\"");
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

  // Keeps the entries of the key apart.
  const char* Spread() const { return medium_.characters() || medium_.tex() ? " width 1" : ""; }

  void Offsets(double above) {
    Line("set offsets graph 0.02, graph 0.02, graph {}, graph 0.03", above);
  }

  // What stands below the last panel.
  void Below(const Figure& figure) {
    text_ += medium_.Caption(figure.sources);
    if (!HasUnnamedMarks(figure.panels.back())) return;
    Line("set label {} at screen 0.01,0.015 left{} textcolor rgb '#666666'",
         medium_.Text(kMarksExplained), medium_.Font(7));
  }

  void Data(const Figure::Panel& panel) {
    for (const Figure::Curve& curve : panel.curves) {
      Line("$curve{} << end", ++written_);
      for (std::size_t i = 0; i < curve.x.size(); ++i) Line("{} {}", curve.x[i], curve.y[i]);
      Line("end");
    }
  }

  void Draw(const Figure::Panel& panel) {
    Line("set xlabel {}", medium_.Text(panel.x_label));
    if (medium_.characters()) {  // Which cannot stand upright: into the frame.
      Line("set label {} at graph 0.02, graph 1 left front",
           medium_.Text(fmt::format(" {} ", panel.y_label)));
    } else {
      Line("set ylabel {}", medium_.Text(panel.y_label));
    }
    Line("{} logscale y", panel.log_y ? "set" : "unset");
    Line("{}", panel.log_y ? "set format y '%.0e'" : "set format y '%g'");
    Line("set xtics {}", panel.counted_x && Longest(panel) <= kMostCounted ? "1" : "autofreq");
    Line("set xrange {}", Range(panel, &Figure::Curve::x, panel.counted_x, false));
    Line("set yrange {}", Range(panel, &Figure::Curve::y, false, panel.log_y));
    if (panel.lowest_y) Line("set yrange [{}:*]", *panel.lowest_y);
    if (!medium_.characters()) Bands(panel);
    Labels(panel);
    for (const double y : panel.dotted_lines) {
      Line(
          "set arrow from graph 0, first {0} to graph 1, first {0} nohead front lc rgb '#444444' "
          "lw 1.5 dt 3",
          y);
    }
    Curves(panel);
    Line("unset object\nunset label\nunset arrow");
  }

  void Bands(const Figure::Panel& panel) {
    for (const Figure::Band& band : panel.bands) {
      Line(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '{}' fillstyle transparent solid {:.2g} noborder",
          band.start, band.end, Colour(band.colour), BandOpacity(panel));
    }
  }

  void Labels(const Figure::Panel& panel) {
    const bool many = panel.labels.size() > kMostLevelLabels;
    if (many && medium_.characters()) return;  // They cannot stand upright.
    for (const Figure::Label& label : panel.labels) {
      Line("set label {} at {},{} {}{}", medium_.Text(label.text), label.x, label.y,
           medium_.characters() ? "center front offset 0,1"
           : many               ? "left rotate by 90 offset 0,0.4"
                                : "center offset 0,0.6",
           medium_.Font(9));
    }
    if (many) Offsets(0.55);
  }

  void Curves(const Figure::Panel& panel) {
    const bool few = std::ranges::count(panel.curves, false, [](const Figure::Curve& curve) {
                       return curve.label.empty();
                     }) <= std::ptrdiff_t{kMostKeys};
    std::string_view separator = "plot ";
    for (const Figure::Curve& curve : panel.curves) {
      text_ += fmt::format("{}$curve{} with {} ", separator, ++drawn_,
                           medium_.characters() ? InCharacters(curve) : InColour(curve));
      const bool keyed = !curve.label.empty() && (few || curve.mark != Figure::Mark::kDashed);
      text_ += keyed ? "title " + medium_.Text(curve.label) : "notitle";
      separator = ", \\\n     ";
    }
    text_ += '\n';
  }

  const Medium medium_;
  std::string text_;
  int written_ = 0;
  int drawn_ = 0;
};

}  // namespace

std::string GnuplotScript(Figure figure, const Medium& medium, const std::string& path) {
  constexpr std::size_t kMostPoints = 4000;  // Of a curve, which is five a pixel.
  Thin(kMostPoints, &figure);
  return Script(medium).Write(figure, path);
}

}  // namespace contact::cli
