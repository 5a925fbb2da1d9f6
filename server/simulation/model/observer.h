#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "simulation/model/ledger.h"

namespace contact {

struct RunState;

/// Receives what a run reports, in order, on the thread that runs it. The run waits for each call
/// to return. A call may throw; the exception leaves Run or Resume.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A pass of the search for μ has ended; those of an episode come before its cycles. An episode
  /// of a cluster that others join is solved anew, with another number: it has no cycles.
  virtual void OnIteration(const Iteration&) {}
  /// A cycle enters the ledger. Cycles come in the order of their end times.
  virtual void OnCycle(const Cycle&) {}
  /// A group of the search takes in its neighbour; what it was, and why it grows. Its μ is the one
  /// with which it begins anew; number, end, status, works and residual are not known yet.
  virtual void OnGrowth(const Group&) {}
  /// A group has ended in the recorded trajectory, or the run cuts it; comes after its cycles.
  virtual void OnGroup(const Group&) {}
  /// The next rows of the recorded trajectory, 1 to RowsPerChunk of them.
  virtual void OnSamples(const Samples&) {}
  /// Called after each episode and each flight between two of them.
  virtual void OnProgress(const Progress&) {}
  /// A sentence for people, without full stop.
  virtual void OnWarning(const std::string&) {}
  /// A step of the integrator begins, also in passes that are not recorded.
  virtual void OnStep() {}
  /// The run is between two episodes. `state` makes what Resume needs to go on from here; it is
  /// valid during the call.
  virtual void OnBoundary(const std::function<RunState()>& /*state*/) {}
};

/// The most rows of Samples in one call of OnSamples. Two such pieces wait for each reader that
/// never reads: with 256 rows of 15 columns 110 kB in all, with 128 it is 76 (fault/drain holds
/// 96). Fewer rows repeat the names of their columns more often.
inline constexpr int kSamplesPerChunk = 128;
/// The most values in one call, unless a single row has more: 512 KiB, so that it fits into a
/// message with the names of its columns.
inline constexpr int kValuesPerChunk = 64 * 1024;

/// The most rows of so many columns, at least 1, in one call of OnSamples.
constexpr int RowsPerChunk(int columns) {
  return std::clamp(kValuesPerChunk / columns, 1, kSamplesPerChunk);
}

}  // namespace contact
