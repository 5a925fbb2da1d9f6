#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// The part of a trajectory that is wanted; by default all of it.
struct SeriesSelection {
  /// Names of columns. `time` is always there; empty: all.
  std::vector<std::string> channels = {};
  /// Start of the time range [s], included.
  std::optional<double> from = {};
  /// End of the time range [s], included.
  std::optional<double> to = {};
  /// Keep one of `every` samples of the range, beginning with its first.
  int every = 1;
  /// If not 0, the server thins the range to that many samples without losing a peak.
  int max_points = 0;

  /// True if all of the trajectory is selected.
  bool empty() const;
};

/// Keeps the selected channels and samples of the columns, `time` first; ignores `max_points`.
/// Throws Failure (kUsage) for an unknown channel.
void Narrow(const SeriesSelection& selection, std::vector<SampleColumn>* columns);

/// Fetches the selected channels and time range of an ended job, thinned by the server to
/// `max_points`; ignores `every`. Throws Failure with all mistakes that the server finds.
std::vector<SampleColumn> ThinnedSeries(Client& client, const std::string& job,
                                        const SeriesSelection& selection);

}  // namespace contact::cli
