#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// The part of a trajectory that is wanted. Nothing in it: all.
struct SeriesSelection {
  std::vector<std::string> channels;  ///< `time` always comes along.
  std::optional<double> from;         ///< [s], itself included.
  std::optional<double> to;           ///< [s], itself included.
  int every = 1;                      ///< The first of so many samples in the range.
  int max_points = 0;                 ///< > 0: thinned by the server without losing a peak.

  bool empty() const;
};

/// Keeps that part of the columns; `every` as well, `max_points` not. Throws Failure (kUsage) for
/// a channel that there is not.
void Narrow(const SeriesSelection& selection, std::vector<SampleColumn>* columns);

/// That part of what an ended job recorded, thinned to `max_points` by the server.
std::vector<SampleColumn> ThinnedSeries(Client& client, const std::string& job,
                                        const SeriesSelection& selection);

}  // namespace contact::cli
