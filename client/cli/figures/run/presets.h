#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/figures/run/run_curves.h"
#include "cli/link/recording.h"

namespace contact::cli {

/// The names of the figures that can be made of a run, such as `force`.
std::vector<std::string> PresetNames();

/// The figure with one of these names, of a part of the run. Throws Failure (kUsage) if the run did
/// not record what the figure shows, and as RunCurves does.
Figure PresetFigure(const std::string& preset, const Recording& recording,
                    const FigurePart& part = {});

/// Channels such as `B1.velocity` over time, a panel for each quantity, in the order in which they
/// are named. Throws Failure (kUsage) for a channel that the run did not record, and as RunCurves
/// does.
Figure ChannelsFigure(const std::vector<std::string>& channels, const Recording& recording,
                      const FigurePart& part = {});

}  // namespace contact::cli
