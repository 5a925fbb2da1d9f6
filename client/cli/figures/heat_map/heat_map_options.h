#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/figures/figure.h"
#include "cli/settings/command_line.h"
#include "cli/text/sweep/sweep_cells.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The flags --metric, --scale and --contour of the commands that show a heat map, or a line where
/// a sweep has one axis, and the picture that they choose.
class HeatMapOptions {
 public:
  /// Declares the flags. This object must outlive `command`, which writes to it.
  void AddTo(CommandLine& line, CLI::App& command);

  /// The metrics as the user named them; the first is drawn. Empty: the first of the sweep.
  const std::vector<std::string>& metrics() const { return metrics_; }

  /// The place of the drawn metric among those of the sweep. Throws Failure (kUsage) if the sweep
  /// has none of this name.
  int MetricOf(const v1::Sweep& sweep) const;

  /// The map in characters, see RenderHeatMap. Throws as MetricOf does.
  std::string Text(const v1::Sweep& sweep, const SweepCells& cells, const Style& style) const;

  /// The line of a sweep over one axis, see SweepLineFigure. Throws as that and MetricOf do.
  Figure Line(const v1::Job& job, const SweepCells& cells) const;

  /// Throws before any cell is solved what Draw would throw for this sweep and path: as MetricOf,
  /// RequireMap and RequireWritable do, and for the ending.
  void RequireDrawable(const v1::Sweep& sweep, const std::string& path) const;

  /// Draws the line or the map to a file in the format of its ending, and prints the path to the
  /// standard error. Throws as MetricOf, SweepLineFigure, HeatMapScript and DrawScript do, and
  /// Failure (kUsage) for an ending of a format in which there are no heat maps.
  void Draw(const v1::Job& job, const SweepCells& cells, const std::string& path) const;

 private:
  /// Draws a heat map.
  void DrawMap(const v1::Job& job, const SweepCells& cells, const std::string& path) const;

  /// As in metrics().
  std::vector<std::string> metrics_;
  /// linear or log.
  std::string scale_ = "linear";
  /// True if Draw adds lines of equal value.
  bool contours_ = false;
};

}  // namespace contact::cli
