#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/input/measured.h"
#include "cli/link/recording.h"

namespace contact::cli {

/// Measured values of one channel, in SI.
struct MeasuredSignal {
  /// The channel, such as `B1.velocity`.
  std::string channel;
  /// The unit of the channel, such as `m/s`.
  std::string unit;
  /// When it was measured, by the clock of the measurement [s]; finite.
  std::vector<double> times = {};
  /// What was measured at these times; finite.
  std::vector<double> values = {};
};

/// The signals of a table, and its columns that are none.
struct MeasuredSignals {
  /// At least one.
  std::vector<MeasuredSignal> signals = {};
  /// Headers of columns that name no channel and were not mapped to one.
  std::vector<std::string> left_out = {};
};

/// Finds the channel of each column: `map` has it by header or by the name in the header, else the
/// name is the channel. `X.force` is `X.contact_force`. The unit of a column is that after the
/// channel in `map`, as in `B1-B2.contact_force [kN]`, else that of the header, else what follows
/// the last `_` of its name if that is a unit, else SI. Times are in the column `time` or `t`.
/// Throws Failure (kUsage) for a map or a unit that does not fit, and if there is no time or no
/// signal.
MeasuredSignals FindSignals(const MeasuredTable& table, const Recording& run,
                            const std::map<std::string, std::string>& map);

}  // namespace contact::cli
