#pragma once

#include <functional>
#include <string>

#include "simulation/model/ledger.h"

namespace contact {

struct RunState;

/// Hears what a run does, in order, on the thread that runs it. What a call takes of time, the
/// run waits.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void OnIteration(const Iteration&) {}
  virtual void OnCycle(const Cycle&) {}        ///< Accepted, in order of end time.
  virtual void OnSamples(const Samples&) {}    ///< At most kSamplesPerChunk rows.
  virtual void OnProgress(const Progress&) {}  ///< After each episode, and in between.
  virtual void OnWarning(const std::string&) {}
  virtual void OnStep() {}  ///< Before each, rejected iterations' included.
  /// Between two episodes: Resume could go on from here. `state` makes what it needs.
  virtual void OnBoundary(const std::function<RunState()>& /*state*/) {}
};

inline constexpr int kSamplesPerChunk = 256;

}  // namespace contact
