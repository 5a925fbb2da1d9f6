#include "simulation/episode/recorder.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "simulation/episode/run_state.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

constexpr double kToldMiss = 0.01;  // Of a law's restitution, relative.
// What the recorded pass may miss by beyond the tolerance, in units of it: its cuts differ from
// those of the search, and so does its round-off.
constexpr double kRecorded = 2;
// What the proof of a row allows. Of its identity (W4): ten tolerances, or what events located to
// round-off leave in weak cycles. Of the kinetic energy where a cycle begins at rest, relative to
// W_c. A work of this part of the energy of all is nothing: its row proves nothing.
constexpr double kIdentity = 10, kLeastIdentity = 1e-7, kAtRest = 1e-8, kNothing = 1e-10;
// Two μ so near, relative, are one root: a root that a scan leaves is more than a tenth larger than
// the one that it takes, and one that comes back differs by about ξ.
constexpr double kSameRoot = 1e-6;

double Ratio(double work_compression, double work_restitution) {
  const double squared = -work_restitution / work_compression;
  return work_compression > 0 && squared >= 0 ? std::sqrt(squared) : kNaN;
}

// What a group is called that the end of the run cuts, by what the search has found beyond it.
Cycle::Status OfCut(Cycle::Status found) {
  const bool guessed = found == Cycle::Status::kUnfinished || found == Cycle::Status::kNotConverged;
  return guessed ? Cycle::Status::kUnfinished : Cycle::Status::kCut;
}

}  // namespace

Recorder::Recorder(const Scenario& scenario, const Motion& motion, Observer& observer,
                   Groups& known)
    : scenario_(scenario),
      motion_(motion),
      observer_(observer),
      known_(known),
      membership_(scenario, motion, known),
      warned_(scenario.contacts.size()),
      missed_(kDampingLaws),
      unproven_(scenario.contacts.size()) {}

void Recorder::Begin(int episode, bool repeatable) {
  episode_ = episode;
  repeatable_ = repeatable;
  disturbed_ = false;
  membership_.Begin(false);
  sound_ = true;
  denies_ = false;
  faults_.clear();
  cycles.clear();
  groups.clear();
}

void Recorder::Save(RunState* state) const {
  state->warned = warned_;
  state->missed = missed_;
  state->unproven = unproven_;
}

void Recorder::Restore(const RunState& state) {
  episode_ = static_cast<int>(state.outcome.episodes);  // Of cycles that rest after it.
  warned_ = state.warned;
  missed_ = state.missed;
  unproven_ = state.unproven;
}

bool Recorder::OnStep() {
  observer_.OnStep();
  return !disturbed_;
}

CycleHost::Factor Recorder::OnStart(ContactState& state, double effective_mass,
                                    double external_force) {
  const bool opens = !state.member.open && !state.settled;
  const double mu = membership_.Start(state, effective_mass, external_force);
  if (state.settled) return {.mu = mu};
  WarnWithoutVelocity(state);
  const Unknown* unknown = known_.Find(Membership::IdOf(state));
  if (opens) Open(state, *unknown);
  if (unknown == nullptr) return {.mu = mu};  // It began before the episode.
  return {.mu = mu, .length = unknown->length, .speed = unknown->speed};
}

double Recorder::OnRelease(ContactState& state, double effective_mass) {
  Group& group = state.member.group;
  const bool iterated =
      scenario_.contacts[At(state.cycle.contact)].damping == DampingLaw::kEnergyRestitution;
  if (iterated) group.status = Cycle::Status::kReleased;
  if (group.number == 0) group.number = ++state.member.groups;
  return membership_.Release(state, effective_mass);
}

// Notes when the rest ends, which the search has not seen: the episode is to be solved again.
bool Recorder::OnDisturbed(const ContactState& state, double cause) {
  if (!repeatable_) return true;
  known_.NoteRestEnd(LastGroup(state), cause);
  disturbed_ = true;
  sound_ = false;
  return false;
}

void Recorder::OnCancel(ContactState& state) {
  const bool numbered = state.member.group.number > 0;
  if (membership_.Cancel(state) && numbered) --state.member.groups;
}

// Writes what the search has found into a group that begins.
void Recorder::Open(ContactState& state, const Unknown& unknown) const {
  const Contact& contact = scenario_.contacts[At(state.cycle.contact)];
  Group& group = state.member.group;
  group.number = unknown.weak ? 0 : ++state.member.groups;
  group.status = unknown.status;
  if (contact.damping != DampingLaw::kEnergyRestitution) group.status = Cycle::Status::kGivenLaw;
  if (IsUndamped(scenario_, state.cycle.contact)) group.status = Cycle::Status::kConverged;
  if (unknown.cut && IsSought(scenario_, state.cycle.contact)) group.status = OfCut(group.status);
  if (!IsGiven(contact.damping)) group.restitution_in = contact.restitution;
  group.restitution_out = unknown.restitution_out;
  group.growth = unknown.growth;
  group.other_roots = unknown.other_roots;
  const bool told = unknown.Decided();
  if (told) group.too_much = unknown.too_much, group.too_little = unknown.too_little;
  state.cycle.iterations = unknown.iterations;
  state.member.iterations = unknown.iterations;
}

void Recorder::WarnWithoutVelocity(const ContactState& state) {
  const Contact& contact = scenario_.contacts[At(state.cycle.contact)];
  const bool named = contact.damping != DampingLaw::kEnergyRestitution &&
                     RowOf(contact.damping).scale == DampingScale::kVelocity;
  const bool has_velocity = contact.reference_velocity > 0 || state.cycle.approach_velocity > 0;
  const std::size_t index = At(state.cycle.contact);
  if (!named || has_velocity || warned_[index]) return;
  warned_[index] = true;
  observer_.OnWarning("contact " + contact.name +
                      " has a cycle that starts at rest, for which its law has no approach "
                      "velocity; it keeps the last μ (0 before the first). "
                      "Give reference_velocity_m_per_s");
}

// Says once for each law that it does not deliver what was asked of it.
void Recorder::WarnOfMiss(const Contact& contact, const Cycle& cycle) {
  const double miss = cycle.restitution_out / contact.restitution - 1;
  const auto law = static_cast<std::size_t>(contact.damping) - 1;
  if (!(std::abs(miss) > kToldMiss) || missed_[law]) return;
  missed_[law] = true;
  observer_.OnWarning("contact " + contact.name + ", cycle " + std::to_string(cycle.number) +
                      ": its law delivers a restitution of " +
                      std::to_string(cycle.restitution_out) + " where " +
                      std::to_string(contact.restitution) + " was asked for; misses of this law " +
                      "above 1 % are told once, and the ledger has them all");
}

// Writes into a cycle what its group is.
void Recorder::Label(const ContactState& state, Cycle& cycle) const {
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  const bool rested = state.phase == Phase::kResting;
  const bool weak = state.member.group.number == 0;
  cycle.episode = episode_;
  cycle.group = rested ? 0 : state.member.group.number;
  if (!IsGiven(contact.damping)) cycle.restitution_in = contact.restitution;
  cycle.status = state.member.group.status;
  cycle.iterations = state.member.iterations;
  if (rested) cycle.restitution_out = kNaN;
  if (rested || (weak && cycle.status != Cycle::Status::kGivenLaw)) {
    cycle.status = Cycle::Status::kSettled;
  }
}

void Recorder::OnEnd(ContactState& state, const Eigen::ArrayXd&, const Eigen::ArrayXd&, double,
                     double) {
  Cycle& cycle = state.cycle;
  const bool rested = !state.member.open;
  const bool ended = membership_.End(state);
  state.member.imbalance += state.imbalance;
  Label(state, cycle);
  if (rested) cycle.group = 0, cycle.status = Cycle::Status::kSettled;
  if (cycle.status == Cycle::Status::kSettled) cycle.restitution_out = kNaN;
  if (!rested && !membership_.IsWeak(state)) {
    if (const std::string fault = Fault(state); !fault.empty()) Disprove(state, fault);
  }
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (cycle.status == Cycle::Status::kGivenLaw && !IsGiven(contact.damping)) {
    WarnOfMiss(contact, cycle);
  }
  cycles.push_back(cycle);
  if (ended) Close(state);
}

// What the recorded motion denies of a cycle that is not negligible; empty: nothing.
std::string Recorder::Fault(const ContactState& state) const {
  const Cycle& cycle = state.cycle;
  const double mass = 0.5 * motion_.equations().effective_mass(cycle.contact);
  const double bound = std::max(kLeastIdentity, kIdentity * scenario_.solver.restitution_tolerance);
  std::ostringstream text;
  const bool ordered = cycle.start_time <= cycle.turn_time && cycle.turn_time <= cycle.end_time;
  const bool woken = state.member.after_rest && cycle.number == state.member.group.first_cycle;
  if (!ordered) {
    text << "its instants are out of order";
  } else if (!(cycle.identity_residual <= bound)) {
    text << "its identity residual is " << cycle.identity_residual << ", above " << bound;
  } else if (cycle.kind == Cycle::Kind::kNirv && !woken &&
             mass * state.start_velocity * state.start_velocity >
                 kAtRest * cycle.work_compression) {
    text << "it begins with " << state.start_velocity << " m/s and not at rest";
  }
  return text.str();
}

// A group of which a row fails its proof is not called anything else, whatever the search believed.
void Recorder::Disprove(ContactState& state, const std::string& fault) {
  const double energy = motion_.equations().Energy(motion_.integrator().y0.data());
  state.member.nothing = state.cycle.work_compression <= kNothing * energy;
  state.member.disproved = true;
  if (state.member.nothing) return;
  faults_.emplace_back(state.cycle.contact, ", cycle " + std::to_string(state.cycle.number) +
                                                " is not proven: " + fault);
}

void Recorder::TellFaults() {
  for (const auto& [contact, fault] : faults_) {
    if (unproven_[At(contact)]) continue;
    unproven_[At(contact)] = true;
    observer_.OnWarning("contact " + scenario_.contacts[At(contact)].name + fault +
                        "; it is told once for each contact");
  }
  faults_.clear();
}

// The group of the cycle that has ended ends with it: sees what it has become.
void Recorder::Close(ContactState& state) {
  Group& group = state.member.group;
  const double ratio = Ratio(group.work_compression, group.work_restitution);
  group.restitution_out = state.released ? kNaN : ratio;
  group.residual =
      state.member.imbalance / std::max(group.work_compression, -group.work_restitution);
  state.member.imbalance = 0;
  const Unknown* unknown = known_.Find(Membership::IdOf(state));
  const bool weak = group.cycles == 1 && membership_.IsWeak(state);
  const bool settled = unknown == nullptr || unknown->flips > 0 || unknown->weak == weak;
  if (group.status != Cycle::Status::kGivenLaw && !settled) sound_ = false;
  if (group.number == 0) return;
  const double allowed = scenario_.solver.restitution_tolerance * group.restitution_in;
  const double miss = std::abs(group.restitution_out - group.restitution_in);
  Cycle::Status status = group.status;
  const bool cut = status == Cycle::Status::kUnfinished || status == Cycle::Status::kCut;
  if (cut) status = Cycle::Status::kNotConverged;  // It has ended.
  if (status == Cycle::Status::kNotConverged && miss <= allowed) status = Cycle::Status::kConverged;
  if (status == Cycle::Status::kConverged && !(miss <= kRecorded * allowed)) {
    status = Cycle::Status::kNotConverged;
  }
  if (state.member.disproved) status = Cycle::Status::kNotConverged;
  const bool answerless =
      status == Cycle::Status::kNotConverged || status == Cycle::Status::kReleased;
  const double work = std::max(group.work_compression, std::abs(group.work_restitution));
  const bool negligible = work <= scenario_.solver.settled_fraction * state.largest_work;
  if (answerless && (weak || negligible || state.member.nothing)) {
    status = Cycle::Status::kSettled;
  }
  group.status = status;
  std::erase_if(group.other_roots, [&](double mu) {
    return status != Cycle::Status::kConverged || mu <= group.mu * (1 + kSameRoot);
  });
  group.beside_cut = group.end_time > known_.cut_since();
  const bool answered = unknown == nullptr || unknown->given_up;
  if (status == Cycle::Status::kNotConverged && !answered) denies_ = true, sound_ = false;
  for (Cycle& cycle : cycles) {
    if (cycle.contact == group.contact && cycle.group == group.number) cycle.status = status;
  }
  state.cycle.status = status;
  groups.push_back(group);
}

void Recorder::FinishCut(ContactState& state) {
  Cycle& cycle = state.cycle;
  Label(state, cycle);
  if (state.phase == Phase::kResting) return;
  Group& group = state.member.group;
  cycle.status = group.status = OfCut(group.status);
  group.beside_cut = true;
  if (group.number == 0) return;
  group.end = Cycle::End::kRunEnd;
  group.end_time = cycle.end_time;
  group.work_compression += cycle.work_compression;
  group.work_restitution += cycle.work_restitution;
  groups.push_back(group);
}

}  // namespace contact
