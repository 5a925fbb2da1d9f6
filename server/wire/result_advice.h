#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/violation.h"

namespace contact {

/// Looks for neighbours that have no contact between them and run into each other. Used by one
/// thread.
class Passings {
 public:
  explicit Passings(const Scenario& scenario);

  /// Takes samples of the scenario's motion, in the order of time.
  void See(const v1::FrameChunk& chunk);

  /// Takes the bodies at the end of a run, in the order of the scenario; may be none.
  void SeeEnd(const v1::Job& result);

  /// Advice on the pair that was the first to overlap, if there is one.
  std::optional<Violation> Advice() const;

 private:
  // Two neighbours, by index.
  struct Pair {
    std::string left_name, right_name;
    int left, right;
    // Least distance of their centres without overlap [m].
    double reach;
    // When they first overlapped [s]; none: not yet.
    std::optional<double> met = {};
  };

  // Notes that a pair has these positions [m] at a time [s].
  static void See(double time, double left, double right, Pair* pair);

  std::vector<Pair> pairs_;
};

/// Advice on the result of a run that reached its end: no contact was touched, neighbours passed
/// through each other, deformations are too large for Hertz's law or for a sphere. `result` has the
/// whole ledger and the bodies at the end.
std::vector<Violation> AdviseOnResult(const Scenario& scenario, const v1::Job& result,
                                      Passings passings);

}  // namespace contact
