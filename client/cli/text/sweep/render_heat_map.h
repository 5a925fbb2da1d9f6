#pragma once

#include <limits>
#include <string>

#include "cli/base/style.h"
#include "cli/text/sweep/sweep_cells.h"

namespace contact::cli {

/// One metric of a sweep over two axes as shades of two characters a cell: the first axis down, the
/// second across. Cells that did not converge carry a `!`, cells that failed are `××`, those whose
/// value the end of the run cuts `][`, those without its contact `()`. `metric` is its place among
/// the metrics of the sweep. With `log` the shades are of its logarithm. Empty unless the sweep is
/// a grid of two axes that fits into the terminal, and has this metric.
std::string RenderHeatMap(const v1::Sweep& sweep, const SweepCells& cells, int metric,
                          const Style& style, bool log = false);

/// The scale of a heat map: which values of a metric it shows, and how high each stands between
/// the lowest and the highest of them.
class HeatScale {
 public:
  /// `metric` is the place of the metric among those of the sweep. With `log` the scale is
  /// logarithmic and shows no value <= 0.
  HeatScale(const SweepCells& cells, int metric, bool log);

  /// The value that the map shows for a cell; NaN if the cell failed, has no finite value that is
  /// known, see SourceOf, or has none that the scale shows.
  double Shown(const v1::SweepCell& cell) const;

  /// The place of a shown value on the scale, from 0 for the lowest to 1 for the highest; 0 if all
  /// values are equal.
  double Height(double value) const;

  /// The place of the metric among those of the sweep.
  int metric() const { return metric_; }
  /// The lowest shown value; infinity if there is none.
  double low() const { return low_; }
  /// The highest shown value; −infinity if there is none.
  double high() const { return high_; }
  /// True if the scale is logarithmic.
  bool log() const { return log_; }
  /// True if all shown values are whole numbers.
  bool whole() const { return whole_; }
  /// The number of finite values that a logarithmic scale cannot show.
  int unshown() const { return unshown_; }
  /// The number of cells that did not fail and have no finite value, without those below.
  int valueless() const { return valueless_; }
  /// The number of cells whose value comes from a cycle that the end of the run cuts.
  int cut() const { return cut_; }
  /// The number of cells without the contact whose value it is.
  int untouched() const { return untouched_; }

 private:
  /// The value of a cell whatever the scale; NaN if the cell failed or has none that is known.
  double Value(const v1::SweepCell& cell) const;
  /// Counts a cell that did not fail and has no value that is shown.
  void CountHole(const v1::SweepCell& cell);

  int metric_;
  bool log_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  bool whole_ = true;
  int unshown_ = 0;
  int valueless_ = 0;
  int cut_ = 0;
  int untouched_ = 0;
};

}  // namespace contact::cli
