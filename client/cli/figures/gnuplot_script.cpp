#include "cli/figures/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

#include "cli/figures/axis_commands.h"
#include "cli/figures/curve_style.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostLevelLabels = 4;  // More labels are written upright.
constexpr std::ptrdiff_t kMostKeys = 8;      // Above it, dashed curves are not in the key.

constexpr char kMarksExplained[] = "o start, × end of a contact cycle";

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
  explicit Script(GnuplotTerminal terminal) : terminal_(terminal) {}

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
    text_ += AxisCommands(panel);
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
