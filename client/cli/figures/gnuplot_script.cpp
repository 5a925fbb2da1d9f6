#include "cli/figures/gnuplot_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/figures/axis_commands.h"
#include "cli/figures/plot_command.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostLevelLabels = 4;  // More labels are written upright.

// Writes a script piece by piece, in the order of the methods below Write.
class Script {
 public:
  explicit Script(const GnuplotTerminal& terminal) : terminal_(terminal) {}

  std::string Write(const Figure& figure, const std::string& path) {
    text_ += Lines(figure.sources, "# ");
    Output(figure, path);
    for (const Figure::Panel& panel : figure.panels) Data(panel);
    Layout(figure);
    for (const Figure::Panel& panel : figure.panels) {
      if (&panel == &figure.panels.back()) {
        text_ += terminal_.CaptionCommands(figure.sources, figure.note);
      }
      Draw(panel, figure.crowd);
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

  // In SI units without prefix; curves are drawn in x_unit and y_unit.
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
    if (!characters && !terminal_.style().paper) Line("set grid lc rgb '#dddddd' lt 1");
    const char* spread = characters || terminal_.tex() ? " width 1" : "";  // Between entries.
    Line("set key tmargin center horizontal{}{}", terminal_.Font(10), spread);
    Offsets(characters ? 0.2 : 0.08);
    if (figure.panels.size() > 1 && !characters) {
      Line("set lmargin at screen {}", terminal_.style().paper ? 0.2 : 0.15);  // Of all y axes.
    }
    const bool titled = terminal_.style().title && !terminal_.style().paper;
    Line("set multiplot layout {},1{}{}", figure.panels.size(),
         titled ? " title " + terminal_.Text(figure.title) : "",
         titled && !characters ? ".\"\\n\"" : "");
  }

  // Free space around the points, the upper part for labels.
  void Offsets(double above) {
    Line("set offsets graph 0.02, graph 0.02, graph {}, graph 0.03", above);
  }

  void Draw(const Figure::Panel& panel, std::size_t crowd) {
    const PanelUnits units = UnitsOf(panel, terminal_.style().units);
    Line("x_unit = {:e}\ny_unit = {:e}", units.x.size, units.y.size);
    AxisLabels(units);
    text_ += AxisCommands(panel, units);
    if (!panel.x_words.empty()) Words(panel);
    if (!terminal_.characters()) Bands(panel);
    Labels(panel);
    DottedLines(panel);
    text_ += PlotCommand(panel, drawn_, crowd, terminal_);
    drawn_ += panel.curves.size();
    Line("unset object\nunset label\nunset arrow");
  }

  // Characters cannot stand upright: there the label of y is a part of the upper border.
  void AxisLabels(const PanelUnits& units) {
    Line("set xlabel {}", terminal_.Text(units.x.label));
    if (terminal_.characters()) {
      Line("set label {} at graph 0.02, graph 1 left front",
           terminal_.Text(fmt::format(" {} ", units.y.label)));
    } else {
      Line("set ylabel {}", terminal_.Text(units.y.label));
    }
  }

  void Words(const Figure::Panel& panel) {
    std::vector<std::string> tics;
    for (const auto& [x, word] : panel.x_words) {
      tics.push_back(fmt::format("{} {}", terminal_.Text(word), x));
    }
    Line("set xtics ({})", fmt::join(tics, ", "));
  }

  void Bands(const Figure::Panel& panel) {
    for (const Figure::Band& band : panel.bands) {
      Line(
          "set object rectangle from first {}/x_unit, graph 0 to first {}/x_unit, graph 1 behind "
          "fillcolor rgb '{}' fillstyle solid noborder",
          band.start, band.end, kBandShade);
    }
  }

  // Many labels are upright, which leaves none of them in characters.
  void Labels(const Figure::Panel& panel) {
    const bool many = panel.labels.size() > kMostLevelLabels;
    if (many && terminal_.characters()) return;
    for (const Figure::Label& label : panel.labels) {
      Line("set label {} at {}/x_unit,{}/y_unit {}{}", terminal_.Text(label.text), label.x, label.y,
           terminal_.characters() ? "center front offset 0,1"
           : many                 ? "left rotate by 90 offset 0,0.4"
                                  : "center offset 0,0.6",
           terminal_.Font(9));
    }
    if (many) Offsets(0.65);
  }

  void DottedLines(const Figure::Panel& panel) {
    for (const double y : panel.dotted_lines) {
      Line(
          "set arrow from graph 0, first {0}/y_unit to graph 1, first {0}/y_unit nohead front "
          "lc rgb '#444444' lw 1.5 dt 3",
          y);
    }
  }

  const GnuplotTerminal& terminal_;
  std::string text_;
  std::size_t written_ = 0;  // Data blocks that the script has.
  std::size_t drawn_ = 0;    // Data blocks that are drawn.
};

// The points of all curves if none has more than `most`.
std::size_t CountPoints(const Figure& figure, std::size_t most) {
  std::size_t points = 0;
  for (const Figure::Panel& panel : figure.panels) {
    for (const Figure::Curve& curve : panel.curves) points += std::min(curve.x.size(), most);
  }
  return points;
}

// Points of a curve that a reader can see: about five for each pixel of the width, and fewer where
// many curves are that long.
std::size_t MostPoints(const Figure& figure) {
  constexpr std::size_t kLeast = 20;
  constexpr std::size_t kInAll = 100'000;
  std::size_t most = 4000;
  while (most > kLeast && CountPoints(figure, most) > kInAll) most = most * 3 / 4;
  return most;
}

}  // namespace

std::string GnuplotScript(Figure figure, const GnuplotTerminal& terminal, const std::string& path) {
  KeepLargest(&figure);
  Thin(MostPoints(figure), &figure);
  return Script(terminal).Write(figure, path);
}

}  // namespace contact::cli
