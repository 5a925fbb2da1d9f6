#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/export/provenance.h"
#include "cli/figures/gnuplot.h"

namespace contact::cli {

/// A drawing of one or more panels below each other, whatever draws it.
struct Figure {
  enum class Mark {
    kLine,
    kDashed,
    kDotted,
    kStart,       ///< o where cycles start.
    kEnd,         ///< × where they end.
    kLinePoints,  ///< Points joined by lines.
  };
  struct Curve {
    std::string label;  ///< Empty: not in the key.
    int colour = 0;
    Mark mark = Mark::kLine;
    std::vector<double> x;
    std::vector<double> y;
  };
  struct Band {
    double start = 0;
    double end = 0;
    int colour = 0;
  };
  struct Label {
    double x = 0;
    double y = 0;
    std::string text;
  };
  struct Panel {
    std::string x_label;
    std::string y_label;
    bool counted_x = false;  ///< x are whole numbers.
    bool log_y = false;
    std::optional<double> lowest_y = {};  ///< Where the y axis starts; otherwise as the data want.
    std::vector<Curve> curves = {};
    std::vector<Band> bands = {};           ///< Over x, behind the curves.
    std::vector<Label> labels = {};         ///< Above their points.
    std::vector<double> dotted_lines = {};  ///< Across at these y.
  };

  std::string title = {};
  std::vector<Panel> panels = {};
  std::vector<Provenance> sources = {};  ///< What it shows; a caption tells it.
};

/// A gnuplot script with its data inside, as many as can be seen, and where they come from, that
/// draws the figure to a file.
std::string GnuplotScript(Figure figure, const Medium& medium, const std::string& path);

/// Leaves at most about `points` of each curve: of points that follow each other the first, the
/// last, the lowest and the highest.
void Thin(std::size_t points, Figure* figure);

/// The points as CSV: for each panel a header with the labels of its axes, then a row a point:
/// curve, x, y.
std::string FigureCsv(const Figure& figure);

}  // namespace contact::cli
