#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
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
    kFaint,       ///< A thin grey line, for what is shown beside,
    kFaintDots,   ///< or a grey dot at each point.
  };

  /// Points (x, y) in the order in which they are joined; `x` and `y` have equal length.
  struct Curve {
    /// Its name: its entry in the key, and the curve in CSV.
    std::string label = {};
    /// Whose curve it is, and its place in the palette, which starts again after its last colour.
    /// Curves of the same colour belong together, such as all those of a contact.
    int colour = 0;
    Mark mark = Mark::kLine;
    /// In the unit of the panel's `x_label`.
    std::vector<double> x = {};
    /// In the unit of the panel's `y_label`.
    std::vector<double> y = {};
    /// False if it has no entry in the key, as without a label.
    bool keyed = true;
  };

  /// A stretch of the x axis with a shade behind the curves.
  struct Band {
    double start = 0;  ///< On the x axis.
    double end = 0;    ///< On the x axis.
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
    /// Values of x and the words at their tics; empty: numbers.
    std::vector<std::pair<double, std::string>> x_words = {};
    /// True if the axis is logarithmic.
    bool log_x = false;
    bool log_y = false;
    /// Lower end of the y axis; none: that of the points.
    std::optional<double> lowest_y = {};
    /// True if the curves that go furthest are the largest ones, not those with the largest |y|.
    bool ranked_by_span = false;
    std::vector<Curve> curves = {};
    /// What dashed curves are, for the key where it cannot list them all.
    std::string dashed = {};
    /// They do not overlap.
    std::vector<Band> bands = {};
    /// What the bands are, for the key.
    std::string band_label = {};
    std::vector<Label> labels = {};
    /// Values of y with a horizontal dotted line across the panel.
    std::vector<double> dotted_lines = {};
  };

  std::string title = {};
  /// From top to bottom.
  std::vector<Panel> panels = {};
  /// The runs that the figure shows, for the caption.
  std::vector<Provenance> sources = {};
  /// What circles and crosses mean that are not in the key, for a line below; empty: none are.
  std::string note = {};
  /// Colours above which KeepLargest leaves curves out of the key.
  std::size_t most_colours = 10;
  /// Colours that it has left out.
  std::size_t crowd = 0;
};

/// Reduces each curve to about `points` points. Of each stretch of points it keeps the first, the
/// last, the lowest and the highest, so that no peak is lost.
void Thin(std::size_t points, Figure* figure);

/// Of a figure with more than `most_colours` leaves these to its largest curves: those with the
/// largest |y|, or the widest span, beside the others of the last panel that they are in. All
/// others become faint, and have no marks.
void KeepLargest(Figure* figure);

/// The points as CSV: for each panel a header with the labels of its axes, then a row a point:
/// curve, x, y.
std::string FigureCsv(const Figure& figure);

}  // namespace contact::cli
