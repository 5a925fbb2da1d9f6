#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/clusters/report.h"
#include "simulation/clusters/trace.h"
#include "simulation/episode/run_state.h"

namespace contact {

/// What is known of the motion to come where bodies that stay together have got to. Contacts have
/// the indices of the whole scenario.
struct Outlook {
  double step = 0;          ///< State::step.
  double solved_until = 0;  ///< As of RunState, and the next.
  double record_until = kNever;
  bool finely = false;
  double cut_since = kNever;
  std::vector<Unknown> unknowns;
  std::vector<RestEnd> rest_ends;
  int episode = 0;  ///< The episode that they were in last.
};

/// Bodies at an instant, with the contacts among them and those with walls and fixed bodies.
struct Cast {
  double time = 0;
  std::vector<int> bodies;    ///< Indices in Scenario::bodies, ascending,
  std::vector<Place> places;  ///< and where each is.
  std::vector<int> contacts;  ///< Indices in Scenario::contacts, ascending,
  std::vector<ContactState> states;
  Outlook outlook;
};

/// Bodies that stay together, and wait for their next piece.
struct Waiting {
  double time = 0;          ///< Since when [s],
  double lasted = 0;        ///< after a piece of this length [s].
  std::vector<int> bodies;  ///< Indices in Scenario::bodies, ascending.
  Outlook outlook;
};

/// A stretch of the motion of some bodies that was solved without the others: at most one flight,
/// and at most one episode after it.
struct Piece {
  std::int64_t number = 0;  ///< In the order in which pieces were tried, from 1.
  int touch = kNone;        ///< The contact that touches where it begins, if that is why.
  Cast start, end;
  std::vector<ContactState> before;  ///< Of the contacts, as they were until it began,
  std::vector<std::shared_ptr<const Waiting>> waited;  ///< and the bodies that waited together.
  Trace trace;
  Report report;
  std::size_t told = 0;  ///< How many items of it were told.
  Motion::Pause pause = Motion::Pause::kQuiet;
  std::string whereabouts;  ///< What was at work at its end, if that is of interest.
  bool has_episode = false;
  std::int64_t steps = 0, evaluations = 0;
  std::int64_t iterations = 0, growths = 0, growths_no_progress = 0;
  double loss = 0;                     ///< Energy dissipated in cycles that ended, or were cut [J].
  double impulse = 0;                  ///< Of walls and fixed bodies [N·s].
  std::vector<bool> warned, unproven;  ///< By contact; see RunState.
  std::vector<bool> missed;

  double begins() const { return start.time; }
  double ends() const { return end.time; }
};

/// Pieces by their number.
using Pieces = std::map<std::int64_t, std::shared_ptr<Piece>>;

/// Solves pieces of a scenario.
class PieceSolver {
 public:
  /// All outlive the solver; the observer hears of steps, passes and growths.
  PieceSolver(const Scenario& scenario, Observer& observer, std::stop_token stop);

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

  const Scenario& scenario_;
  Observer& observer_;
  const std::stop_token stop_;
  std::vector<std::vector<int>> loads_;  // Of each body.
};

}  // namespace contact
