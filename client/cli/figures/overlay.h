#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"
#include "cli/text/comparison/measured_signals.h"
#include "cli/text/comparison/signal_comparison.h"

namespace contact::cli {

/// The same channels of several runs over each other, a panel for each channel, a colour for each
/// run; the key names a run by the parameters in which it differs. Without channels: the forces of
/// the first three contacts. Throws Failure (kUsage) if a run did not record a channel.
Figure OverlayFigure(const std::vector<Recording>& runs, const std::vector<std::string>& channels);

/// Measured signals, as points, over those of a run, as lines: a panel for each of the first four.
/// `comparison` is
/// that of the signals with this run; its shift moves the points. Of the run the figure shows the
/// time that was measured, and a little around it.
Figure MeasuredFigure(const Recording& run, const std::vector<MeasuredSignal>& signals,
                      const SignalComparison& comparison);

}  // namespace contact::cli
