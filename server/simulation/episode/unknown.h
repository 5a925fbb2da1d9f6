#pragma once

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "simulation/model/ledger.h"
#include "simulation/motion/motion.h"

namespace contact {

/// Names a group of cycles from pass to pass. What happens in one encounter renames no group of
/// another one.
struct GroupId {
  int contact = 0;    ///< Index in Scenario::contacts.
  int encounter = 1;  ///< Place among the encounters of the contact, from 1.
  int place = 1;      ///< Place among the groups of the encounter, from 1.
  bool operator==(const GroupId&) const = default;
  bool operator<(const GroupId& other) const {
    return std::tie(contact, encounter, place) <
           std::tie(other.contact, other.encounter, other.place);
  }
};

/// What the search knows of a group, whatever the last pass has shown: plain values, so that a
/// checkpoint can keep them.
struct Unknown {
  GroupId id;
  double mu = 0;          ///< μ of the next pass [N·s/mⁿ⁺¹].
  double first_mu = 0;    ///< The first guess.
  double lasts = 0;       ///< It does not end earlier after its start [s]: see Groups::Merge.
  double start_time = 0;  ///< Of the last pass that saw it [s].
  double restitution_out = kNaN;  ///< Of the last scan that saw its end.
  double length = 0;              ///< Expected δ_m − δ_s [m], and
  double speed = 0;               ///< largest |δ̇| [m/s] of its cycles; 0: unknown.
  bool corrected = false;         ///< μ is no mere guess any more.
  bool kept = false;              ///< μ is a guess that stays: see Membership::Guess.
  int guesses = 0;                ///< How often a kept guess was poor and made again.
  bool weak = false;              ///< Its work was negligible in the last pass.
  int reopened = 0;               ///< How often it ended after all, once it was found unfinished.
  int flips = 0;                  ///< How often it became negligible, or was no more.
  bool cut = false;               ///< It does not end before the end of the run.
  bool given_up = false;          ///< As many corrections as are allowed did not solve it.
  bool waits = false;  ///< For guesses that overlap it: what it misses tells nothing yet.
  int iterations = 0;  ///< Corrections of μ by the search that found it.
  Growth growth = Growth::kNotGrown;
  /// kConverged, kJump, kLimited, kInfeasible, kUnfinished: found. kNotConverged: still sought.
  Cycle::Status status = Cycle::Status::kNotConverged;
  Group::Reached too_much, too_little;
  double tried = 0;  ///< What lasts longer in a trial of the search does not end in it [s].
  std::vector<double> other_roots;  ///< Larger μ that solve its balance, too, as they were seen.

  /// Whether the search leaves it alone from now on.
  bool Decided() const {
    return given_up ||
           (status != Cycle::Status::kNotConverged && status != Cycle::Status::kConverged);
  }
};

/// A group as one pass has seen it.
struct GroupSight {
  GroupId id;
  double mu = 0;
  double restitution_in = kNaN;
  bool sought = false;      ///< Its μ is to be found; else a law gives it.
  bool ended = false;       ///< In the pass.
  bool separated = false;   ///< How it ended.
  bool weak = false;        ///< Negligible work.
  bool released = false;    ///< A restitution without compression before it; not sought.
  bool after_rest = false;  ///< Before it the contact has rested: it joins none before.
  int first_cycle = 1, cycles = 0;
  double start_time = 0, end_time = 0, last_turn = 0;
  double work_compression = 0, work_restitution = 0;
  double squared = kNaN;       ///< ε_out² = −W_r/W_c.
  double residual = kNaN;      ///< A(ε_out)/A(ε_in) − 1.
  double frozen_slope = kNaN;  ///< Paper (30).
  double length = 0, speed = 0;
  double depth = 0;                          ///< Largest δ of its cycles [m].
  double bracket_low = 0, bracket_high = 0;  ///< μ known to give too much, too little; 0: none.
  Iteration::Update update = Iteration::Update::kNothing;  ///< How μ is changed after the pass.
  int column = kNone;
  Eigen::ArrayXd gradient_compression, gradient_restitution;  ///< ∂W/∂μ of each column.
  Eigen::ArrayXd gradient;                                    ///< ∂residual/∂μ of each column.

  /// ε_out/ε_in − 1.
  double Miss() const;
  /// The works that the group misses its balance by, |W_r + ε² W_c| [J].
  double Missing() const;
  /// ∂(ε_out²)/∂μ by its own μ, of a pass with slopes.
  double SlopeOfSquare() const;
};

/// What one pass has shown.
struct Sight {
  std::vector<GroupSight> groups;  ///< In order of start.
  std::vector<double> quiet;       ///< Instants at which no cycle ran [s].
  Motion::Pause pause = Motion::Pause::kQuiet;
  double time = 0;         ///< Reached [s].
  bool crowded = false;    ///< It saw as many cycles as it was to see, and there are more.
  bool disturbed = false;  ///< A rest in it should have ended earlier: it shows nothing.
  bool exact = true;       ///< It was as exact as the scenario asks.

  const GroupSight* Find(const GroupId& id) const;
};

}  // namespace contact
