#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
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

  /// Throws before any cell is solved what contactsim would say of this sweep and path: Failure
  /// (kUsage) unless a sweep of two axes is a grid with few enough cells and for a wrong ending,
  /// (kLocal) if the file cannot be written; and as MetricOf does.
  void RequireDrawable(const v1::Sweep& sweep, const std::string& path) const;

  /// The words with which contactsim draws a sweep, but for its file.
  std::vector<std::string> Words(const std::string& job) const;

  /// Draws the line or the map to a file in the format of its ending, and prints the path to the
  /// standard error. Throws as RunContactsim does.
  void Draw(const v1::Job& job, const std::string& path, const Settings& settings) const;

 private:
  /// As in metrics().
  std::vector<std::string> metrics_;
  /// linear or log.
  std::string scale_ = "linear";
  /// True if Draw adds lines of equal value.
  bool contours_ = false;
};

}  // namespace contact::cli
