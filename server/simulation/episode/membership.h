#pragma once

#include "simulation/episode/first_guess.h"
#include "simulation/episode/groups.h"

namespace contact {

/// Whether the μ of this contact is known to be 0: an encounter without damping gives back all its
/// work, ε = 1.
bool IsUndamped(const Scenario& scenario, int contact);
/// Whether the μ of this contact is to be found.
bool IsSought(const Scenario& scenario, int contact);

/// Puts the cycles of a pass into groups and gives them their μ. Whoever hosts a pass asks it at
/// each start and end of a cycle.
class Membership {
 public:
  Membership(const Scenario& scenario, const Motion& motion, Groups& groups)
      : scenario_(scenario),
        packing_(IsPacking(scenario)),
        guess_(scenario, motion),
        groups_(groups) {}

  /// A pass begins. Groups that begin at `guess_from` [s] or later, and whose μ is a mere guess,
  /// are guessed anew.
  void Begin(double guess_from);

  /// A cycle starts: takes it into the open group of its contact, or opens one. Returns its μ.
  double Start(ContactState& state, double effective_mass, double external_force);

  /// A cycle has ended: adds its works to its group, and sees whether the group ends with it and
  /// whether the contact comes to rest. Returns whether the group has ended.
  bool End(ContactState& state);

  /// The cycle that started last gives back what was stored before it. Returns its μ.
  double Release(ContactState& state, double effective_mass) const;

  /// When the rest of a contact that follows its last group ends [s].
  double RestEnd(const ContactState& state) const { return groups_.RestEnd(LastGroup(state)); }

  /// The cycle that started last is none after all. Returns whether its group is none either.
  bool Cancel(ContactState& state);

  /// Whether the works of the cycle that has ended are negligible beside that of its contact;
  /// `times` what is negligible else.
  bool IsWeak(const ContactState& state, double times = 1) const;
  static GroupId IdOf(const ContactState& state) {
    return {state.cycle.contact, state.encounter, state.member.place};
  }

 private:
  void Open(ContactState& state, double effective_mass, double external_force);
  void Guess(Unknown& unknown, double mu) const;

  const Scenario& scenario_;
  const bool packing_;
  FirstGuess guess_;
  Groups& groups_;
  double guess_from_ = -1e300;
};

}  // namespace contact
