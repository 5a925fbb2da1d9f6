#pragma once

#include <string>
#include <vector>

#include "cli/figure.h"
#include "cli/recording.h"

namespace contact::cli {

/// Names of the figures that can be drawn of a run.
std::vector<std::string> PresetNames();

/// The figure with this name. Throws Failure (kUsage) if the run did not record what it shows.
Figure DrawPreset(const std::string& preset, const Recording& recording);

}  // namespace contact::cli
