#pragma once

#include <limits>

#include "cli/text/sweep_cells.h"

namespace contact::cli {

/// The values of a metric that a heat map shows, from the lowest to the highest.
class HeatScale {
 public:
  /// With `log`, values <= 0 are not shown: they have no logarithm.
  HeatScale(const SweepCells& cells, int metric, bool log);

  /// What a cell shows; NaN if it failed, or has no such value.
  double Shown(const v1::SweepCell& cell) const;

  /// How far a shown value is from the lowest to the highest: 0 to 1.
  double Height(double value) const;

  int metric() const { return metric_; }
  double low() const { return low_; }    ///< Infinite without values.
  double high() const { return high_; }  ///< −infinite without values.
  bool log() const { return log_; }
  bool whole() const { return whole_; }     ///< All values are whole numbers.
  int unshown() const { return unshown_; }  ///< How many values have no logarithm.

 private:
  double Value(const v1::SweepCell& cell) const;

  int metric_;
  bool log_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  bool whole_ = true;
  int unshown_ = 0;
};

}  // namespace contact::cli
