#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "simulation/ledger.h"
#include "simulation/scenario.h"

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

/// Solves a scenario from 0 to its end time. A pure function: same scenario, same calls of the
/// observer and same outcome, to the byte. `stop` is looked at in every step.
Outcome Run(const Scenario& scenario, Observer& observer, std::stop_token stop = {});

/// Goes on from a boundary of an earlier run of the same scenario by the same program: calls the
/// observer as that run would have done from there on, and has its outcome, to the byte.
Outcome Resume(const Scenario& scenario, const RunState& from, Observer& observer,
               std::stop_token stop = {});

}  // namespace contact
