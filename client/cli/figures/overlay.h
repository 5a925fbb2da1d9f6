#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"

namespace contact::cli {

/// The same channels of several runs over each other, a panel for each channel, a colour for each
/// run; the key names a run by the parameters in which it differs. Without channels: the forces of
/// the first three contacts. Throws Failure (kUsage) if a run did not record a channel.
Figure OverlayFigure(const std::vector<Recording>& runs, const std::vector<std::string>& channels);

}  // namespace contact::cli
