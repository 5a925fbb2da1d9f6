#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/figures/form/figure_style.h"
#include "cli/figures/run/run_curves.h"
#include "cli/settings/command_line.h"

namespace contact::cli {

/// The flags of `plot` that say what part of a run a figure shows, and how it looks.
class PlotOptions {
 public:
  /// Declares the flags. This object must outlive `command`, which writes to it.
  void AddTo(CommandLine& line, CLI::App& command);

  /// What the figure shows of the run.
  const FigurePart& part() const { return part_; }
  /// How it looks. Throws Failure (kUsage) for a size or a font that is none.
  FigureStyle Look() const;
  /// Makes the axes of a figure those that the flags ask for. Throws Failure (kUsage) if no axis
  /// can have a unit that is named, or if nothing is left to show on a logarithmic axis.
  void Adapt(Figure* figure) const;

 private:
  void AddPart(CommandLine& line, CLI::App& command);
  void AddLook(CommandLine& line, CLI::App& command);

  FigurePart part_;
  std::string size_;
  std::string font_;
  std::string style_ = "colour";
  std::vector<std::string> units_;
  bool log_ = false;
  bool no_title_ = false;
  bool no_provenance_ = false;
};

}  // namespace contact::cli
