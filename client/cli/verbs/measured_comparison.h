#pragma once

#include <CLI/App.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/settings/command_line.h"
#include "cli/text/comparison/signal_comparison.h"

namespace contact::cli {

/// The part of `compare` that sets a job beside a file of measured data.
class MeasuredComparison {
 public:
  /// Adds --map, --tolerance, --shift and --fit-shift. This object must outlive the parsing.
  void AddTo(CLI::App& command);

  /// The first of its flags that the user gave; empty: none.
  std::string GivenFlag() const;

  /// Compares the job with the file, prints as -o asks, and draws to `plot` unless that is empty.
  /// `common` is the tolerance of signals without one of their own. Returns kDiffers if a signal is
  /// not within its tolerance. Throws Failure and CallFailure.
  ExitCode Run(const std::string& job, const std::string& file, const SignalTolerance& common,
               const std::string& plot, const Settings& settings) const;

 private:
  std::vector<std::string> map_;         // HEADER=CHANNEL
  std::vector<std::string> tolerances_;  // CHANNEL=TOLERANCE
  std::optional<double> shift_;          // [s]
  std::string fit_;                      // LOW:HIGH [s]; empty: not given
};

/// Reads `CHANNEL=TOLERANCE` texts: a number in a unit of the channel, SI without one, or a
/// percentage of the peak: `B1-B2.contact_force=5 kN`, `B1.velocity=3%`. Throws Failure (kUsage)
/// for a text that is none, and for a channel that is not among the signals.
std::map<std::string, SignalTolerance> ReadTolerances(const std::vector<std::string>& texts,
                                                      const std::vector<MeasuredSignal>& signals);

}  // namespace contact::cli
