#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
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
  double loss = 0;     ///< Dissipated in supports, and in cycles that ended or were cut [J].
  double work = 0;     ///< Of drives, and of loads that are not steady [J],
  double impulse = 0;  ///< and their impulse, with that of walls, fixed bodies, supports [N·s].
  std::vector<bool> warned, unproven;  ///< By contact; see RunState.
  std::vector<bool> missed;

  /// Whether it may end at any instant instead: nothing but a flight.
  bool IsFlight() const { return !has_episode && report.items.empty(); }
  double begins() const { return start.time; }
  double ends() const { return end.time; }
};

/// Pieces by their number.
using Pieces = std::map<std::int64_t, std::shared_ptr<Piece>>;

}  // namespace contact
