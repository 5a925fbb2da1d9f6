#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/comparison/signal_comparison.h"

namespace contact::cli {

/// A comparison with measured data for people: a line a signal, then shift and verdict.
std::string RenderSignals(const SignalComparison& comparison, const Style& style);

/// The same as one JSON document: job, file, shift_s, fitted_between_s, holds, signals. All numbers
/// are in SI.
std::string SignalsJson(const SignalComparison& comparison);

/// The same as CSV, a line a signal, with all digits.
std::string SignalsCsv(const SignalComparison& comparison);

}  // namespace contact::cli
