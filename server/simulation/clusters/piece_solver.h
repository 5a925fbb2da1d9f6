#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>

#include "simulation/clusters/world.h"
#include "simulation/model/observer.h"

namespace contact {

/// Solves pieces of a scenario.
class PieceSolver {
 public:
  /// All outlive the solver; the observer hears of steps, passes and growths.
  PieceSolver(const World& world, Observer& observer, std::stop_token stop);

  /// The piece that begins so; if it begins with a flight, to `until` at most [s]. `run`: what was
  /// told already, and the steps that were spent.
  std::shared_ptr<Piece> Solve(Cast start, std::int64_t number, double until,
                               const RunState& run) const;
  /// About how it would go to `until` [s], or the first instant without a cycle: nothing of it is
  /// solved.
  std::shared_ptr<Piece> Look(Cast start, double until, const RunState& run) const;

 private:
  struct Work;
  Scenario PartOf(const Cast& cast) const;
  RunState Begin(const Cast& cast, const Scenario& part, const RunState& run) const;
  void Go(double until, Work* work) const;
  void Cut(Work* work) const;
  void Close(const RunState& run, Work* work) const;

  const World& world_;
  const Scenario& scenario_;
  Observer& observer_;
  const std::stop_token stop_;
};

}  // namespace contact
