#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/recording.h"
#include "cli/text/comparison/measured_signals.h"

namespace contact::cli {

/// How far measured values may be from the simulated ones: max(absolute, relative · |peak|), with
/// the largest measured value as peak.
struct SignalTolerance {
  /// In the unit of the channel.
  double absolute = 0;
  /// A fraction of the peak.
  double relative = 0.05;
};

/// An interval of time [s]; low < high.
struct TimeRange {
  double low = 0;
  double high = 0;
};

/// Measured signals beside those of a run. Simulated time is measured time plus `shift`.
struct SignalComparison {
  /// One signal.
  struct Row {
    std::string channel;
    std::string unit;
    /// Measured points within the run, and those outside of it, which do not count.
    std::size_t points = 0;
    std::size_t outside = 0;
    /// Root of the mean squared deviation, measured − simulated, in `unit`.
    double rms = 0;
    /// The deviation of largest size, in `unit`, and its measured time [s].
    double largest = 0;
    double largest_time = 0;
    /// The values of largest size, in `unit`; the simulated one between the first and the last
    /// point.
    double measured_peak = 0;
    double simulated_peak = 0;
    /// What |largest| may be, in `unit`.
    double allowed = 0;

    bool Holds() const;
  };

  std::string job;   ///< `jobs/ID`.
  std::string file;  ///< As the user named it.
  double shift = 0;  ///< [s].
  /// Where the shift was looked for; none: it was given.
  std::optional<TimeRange> fitted = {};
  std::vector<Row> rows = {};

  /// True if every row holds.
  bool Holds() const;
};

/// The shift in `range` at which the signals are nearest to the run: the least mean of their
/// squared deviations, each relative to its peak. Looks at a thousand shifts, then refines the best
/// one. Throws Failure (kUsage) if at none of them half of the points lie within the run.
double FitShift(const std::vector<MeasuredSignal>& signals, const Recording& run,
                const TimeRange& range);

/// Compares the signals with the run, between whose samples it interpolates. `own` has the
/// tolerances of channels that have not the common one. Throws Failure (kUsage) if no point of a
/// signal lies within the run.
SignalComparison Compare(const std::vector<MeasuredSignal>& signals, const Recording& run,
                         double shift, const SignalTolerance& common,
                         const std::map<std::string, SignalTolerance>& own);

}  // namespace contact::cli
