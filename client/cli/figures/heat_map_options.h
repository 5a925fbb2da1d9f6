#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/settings/command_line.h"
#include "cli/text/render_sweep.h"

namespace contact::cli {

/// The flags of commands that show a heat map: which metric, and how.
class HeatMapOptions {
 public:
  /// Adds the flags. This object must outlive the parsing.
  void AddTo(CommandLine& line, CLI::App& command);

  const std::string& metric() const { return metric_; }  ///< Empty: the first.

  /// Throws Failure (kUsage) if the sweep has no such metric.
  int MetricOf(const v1::Sweep& sweep) const;

  /// As render_sweep.h has it.
  std::string Text(const v1::Sweep& sweep, const SweepCells& cells, const Style& style) const;

  /// Draws it to a file, whose ending tells the format, and says so. Throws Failure: kUsage if it
  /// is of no such format, or as HeatMapScript and DrawScript do.
  void Draw(const v1::Job& job, const SweepCells& cells, const std::string& path) const;

 private:
  std::string metric_;
  std::string scale_ = "linear";
  bool contours_ = false;
};

}  // namespace contact::cli
