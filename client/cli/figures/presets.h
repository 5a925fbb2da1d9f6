#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"

namespace contact::cli {

/// Names of the figures that can be drawn of a run.
std::vector<std::string> PresetNames();

/// The figure with this name. Throws Failure (kUsage) if the run did not record what it shows.
Figure DrawPreset(const std::string& preset, const Recording& recording);

/// What to tell of cycles that lasted too short to be seen in the samples, and the command that
/// records more; empty if there are none.
std::string CoarseSampling(const Recording& recording);

}  // namespace contact::cli
