#include "simulation/episode/membership.h"

#include <algorithm>
#include <cmath>

#include "simulation/episode/search_options.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// A kept guess that is off by more than this, relative, is poor, and made again.
constexpr double kPoorShare = 0.2;
// A contact does not rest for less than this part of the cycle before.
constexpr double kSoon = 0.1;

}  // namespace

bool IsUndamped(const Scenario& scenario, int contact) {
  const Contact& c = scenario.contacts[At(contact)];
  return c.damping == DampingLaw::kEnergyRestitution && c.restitution == 1 &&
         scenario.solver.update == UpdateRule::kNewtonCoupled &&
         scenario.solver.restitution_scope != RestitutionScope::kCycle;
}

bool IsSought(const Scenario& scenario, int contact) {
  return scenario.contacts[At(contact)].damping == DampingLaw::kEnergyRestitution &&
         !IsUndamped(scenario, contact);
}

void Membership::Begin(double guess_from) {
  guess_from_ = guess_from;
  guess_.Begin();
}

bool Membership::IsWeak(const ContactState& state, double times) const {
  const SolverOptions& options = scenario_.solver;
  const double fraction = state.cycle.kind == Cycle::Kind::kNirv ? options.settled_nirv_fraction
                                                                 : options.settled_fraction;
  const double work =
      std::max(state.cycle.work_compression, std::abs(state.cycle.work_restitution));
  return work <= times * fraction * state.largest_work;
}

double Membership::Start(ContactState& state, double effective_mass, double external_force) {
  guess_.Observe(state.cycle.approach_velocity);
  ContactState::Membership& member = state.member;
  const bool pressed_at_start = std::isnan(state.last_mu) && (state.woken || state.settled);
  if (pressed_at_start) {
    state.last_mu = guess_.Released(state, effective_mass);
  }
  if (state.settled) {  // It rests, in no group.
    member.open = false;
    return state.last_mu;
  }
  if (!member.open) Open(state, effective_mass, external_force);
  ++member.group.cycles;
  return member.group.mu;
}

void Membership::Open(ContactState& state, double effective_mass, double external_force) {
  const Cycle& cycle = state.cycle;
  ContactState::Membership& member = state.member;
  member.place =
      member.group.encounter == state.encounter && member.place > 0 ? member.place + 1 : 1;
  member.open = true;
  member.after_rest = state.woken;
  member.disproved = member.nothing = false;
  member.group = {};
  member.group.contact = cycle.contact;
  member.group.encounter = state.encounter;
  member.group.first_cycle = cycle.number;
  member.group.start_time = cycle.start_time;
  Unknown& unknown = groups_.At(IdOf(state));
  unknown.start_time = cycle.start_time;
  const bool law = !IsSought(scenario_, cycle.contact);
  if (law || (!unknown.corrected && (cycle.start_time >= guess_from_ || unknown.first_mu == 0))) {
    double mu = guess_.Factor(state, effective_mass, external_force);
    if (std::isnan(mu)) mu = std::isnan(state.last_mu) ? 0 : state.last_mu;
    Guess(unknown, mu);
  }
  const bool keeps = unknown.weak && !law && state.last_mu > 0;
  member.group.mu = keeps ? state.last_mu : unknown.mu;
  member.lasts = unknown.lasts;
}

// A guess is kept once what overlaps it was solved, unless a better one shows that it was poor: a
// pulse in a row reaches contacts long before those that it has left are solved, and what was
// guessed of them then follows from guesses alone. With a μ that is too small they rattle without
// end. In packings guesses follow from loads, and stay.
void Membership::Guess(Unknown& unknown, double mu) const {
  if (unknown.kept && unknown.first_mu > 0 && IsSought(scenario_, unknown.id.contact)) {
    const bool poor = std::abs(mu - unknown.mu) > kPoorShare * unknown.mu;
    if (!poor || packing_ || unknown.id.place > 1 || unknown.guesses == kSearch.revisions) return;
    ++unknown.guesses;
  }
  unknown.mu = unknown.first_mu = mu;
}

double Membership::Release(ContactState& state, double effective_mass) const {
  state.member.lasts = 0;
  return state.member.group.mu = guess_.Released(state, effective_mass);
}

bool Membership::Cancel(ContactState& state) {
  ContactState::Membership& member = state.member;
  if (!member.open || --member.group.cycles > 0) return false;
  member.open = false;
  --member.place;
  return true;
}

bool Membership::End(ContactState& state) {
  const Cycle& cycle = state.cycle;
  ContactState::Membership& member = state.member;
  if (!member.open) {  // It has rested.
    state.settled = IsWeak(state);
    return false;
  }
  Group& group = member.group;
  group.end_time = cycle.end_time;
  group.end = cycle.end;
  group.work_compression += cycle.work_compression;
  group.work_restitution += cycle.work_restitution;
  const bool encounter = scenario_.solver.restitution_scope == RestitutionScope::kEncounter;
  const int least =
      encounter && IsSought(scenario_, cycle.contact) ? scenario_.solver.encounter_cycles : 1;
  const bool weak = IsWeak(state), one = weak || groups_.At(IdOf(state)).weak;
  const bool lasts = cycle.end_time - group.start_time < member.lasts ||
                     (group.cycles < least && !one) || IsUndamped(scenario_, cycle.contact);
  member.open = cycle.end == Cycle::End::kNonSeparation && lasts && !state.released;
  const double soon = cycle.end_time + kSoon * (cycle.end_time - cycle.start_time);
  state.settled = !member.open && weak && RestEnd(state) > soon;
  return !member.open;
}

}  // namespace contact
