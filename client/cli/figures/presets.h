#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"

namespace contact::cli {

/// The names of the figures that can be made of a run, such as `force`.
std::vector<std::string> PresetNames();

/// The figure with one of these names. Throws Failure (kUsage) if the run did not record what the
/// figure shows.
Figure PresetFigure(const std::string& preset, const Recording& recording);

}  // namespace contact::cli
