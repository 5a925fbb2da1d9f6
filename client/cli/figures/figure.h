#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/export/provenance.h"

namespace contact::cli {

/// What a figure shows: panels below each other with curves, marks and labels. Plain values, which
/// gnuplot_script.h turns into a script and FigureCsv into points.
struct Figure {
  /// How the points of a curve are drawn.
  enum class Mark {
    kLine,
    kDashed,
    kDotted,
    kStart,       ///< A circle at each point: where cycles start.
    kEnd,         ///< A cross at each point: where cycles end.
    kLinePoints,  ///< A circle at each point, joined by lines.
    kPoints,      ///< A small dot at each point.
  };

  /// Points (x, y) in the order in which they are joined; `x` and `y` have equal length.
  struct Curve {
    /// Its entry in the key; empty: none.
    std::string label = {};
    /// Place in the palette, which starts again after its last colour.
    int colour = 0;
    Mark mark = Mark::kLine;
    /// In the unit of the panel's `x_label`.
    std::vector<double> x = {};
    /// In the unit of the panel's `y_label`.
    std::vector<double> y = {};
  };

  /// A stretch of the x axis with a shade behind the curves.
  struct Band {
    double start = 0;  ///< On the x axis.
    double end = 0;    ///< On the x axis.
    /// Place in the palette, which starts again after its last colour.
    int colour = 0;
  };

  /// A text above a point.
  struct Label {
    double x = 0;
    double y = 0;
    std::string text;
  };

  /// One pair of axes.
  struct Panel {
    std::string x_label;  ///< Quantity and unit, such as `time [s]`.
    std::string y_label;  ///< Quantity and unit.
    /// True if x are whole numbers, such as passes: tics and range are then whole.
    bool counted_x = false;
    /// True if the y axis is logarithmic.
    bool log_y = false;
    /// Lower end of the y axis; none: that of the points.
    std::optional<double> lowest_y = {};
    std::vector<Curve> curves = {};
    std::vector<Band> bands = {};
    std::vector<Label> labels = {};
    /// Values of y with a horizontal dotted line across the panel.
    std::vector<double> dotted_lines = {};
  };

  std::string title = {};
  /// From top to bottom.
  std::vector<Panel> panels = {};
  /// The runs that the figure shows, for the caption.
  std::vector<Provenance> sources = {};
};

/// Reduces each curve to about `points` points. Of each stretch of points it keeps the first, the
/// last, the lowest and the highest, so that no peak is lost.
void Thin(std::size_t points, Figure* figure);

/// The points as CSV: for each panel a header with the labels of its axes, then a row a point:
/// curve, x, y.
std::string FigureCsv(const Figure& figure);

}  // namespace contact::cli
