#include "wire/ledger_codec.h"

#include <cmath>
#include <cstddef>

namespace contact {
namespace {

const Contact& ContactAt(const Scenario& scenario, int index) {
  return scenario.contacts[static_cast<std::size_t>(index)];
}

// The enums of the contract have the order of the ledger's, after a first value for unspecified.
template <class Value, class Enum>
constexpr Value Next(Enum value) {
  return static_cast<Value>(static_cast<int>(value) + 1);
}
constexpr auto WireKind = Next<v1::Cycle::Kind, Cycle::Kind>;
static_assert(WireKind(Cycle::Kind::kCollision) == v1::Cycle::COLLISION);
static_assert(WireKind(Cycle::Kind::kNirv) == v1::Cycle::NIRV);
constexpr auto WireEnd = Next<v1::Cycle::End, Cycle::End>;
static_assert(WireEnd(Cycle::End::kSeparation) == v1::Cycle::SEPARATION);
static_assert(WireEnd(Cycle::End::kNonSeparation) == v1::Cycle::NON_SEPARATION);
static_assert(WireEnd(Cycle::End::kRunEnd) == v1::Cycle::RUN_END);
constexpr auto WireStatus = Next<v1::Cycle::Status, Cycle::Status>;
static_assert(WireStatus(Cycle::Status::kConverged) == v1::Cycle::CONVERGED);
static_assert(WireStatus(Cycle::Status::kGivenLaw) == v1::Cycle::GIVEN_LAW);
static_assert(WireStatus(Cycle::Status::kInfeasible) == v1::Cycle::INFEASIBLE);
static_assert(WireStatus(Cycle::Status::kSettled) == v1::Cycle::SETTLED);
static_assert(WireStatus(Cycle::Status::kNotConverged) == v1::Cycle::NOT_CONVERGED);
static_assert(WireStatus(Cycle::Status::kJump) == v1::Cycle::JUMP);
static_assert(WireStatus(Cycle::Status::kUnfinished) == v1::Cycle::UNFINISHED);
static_assert(WireStatus(Cycle::Status::kReleased) == v1::Cycle::RELEASED);
static_assert(WireStatus(Cycle::Status::kLimited) == v1::Cycle::LIMITED);
static_assert(WireStatus(Cycle::Status::kCut) == v1::Cycle::CUT);
constexpr auto WireGrowth = Next<v1::Group::Growth, Growth>;
static_assert(WireGrowth(Growth::kNotGrown) == v1::Group::NOT_GROWN);
static_assert(WireGrowth(Growth::kTooLittle) == v1::Group::TOO_LITTLE);
static_assert(WireGrowth(Growth::kTooMuch) == v1::Group::TOO_MUCH);
static_assert(WireGrowth(Growth::kJump) == v1::Group::JUMP);
static_assert(WireGrowth(Growth::kNoProgress) == v1::Group::NO_PROGRESS);

// Whether a cycle has both δ̇⁻ and δ̇⁺.
bool HasNewtonRestitution(const Cycle& cycle) {
  return cycle.approach_velocity > 0 && cycle.end == Cycle::End::kSeparation;
}

}  // namespace

v1::Cycle Encode(const Scenario& scenario, const Cycle& cycle) {
  const Contact& contact = ContactAt(scenario, cycle.contact);
  v1::Cycle message;
  message.set_contact(contact.name);
  message.set_number(cycle.number);
  message.set_kind(WireKind(cycle.kind));
  message.set_end(WireEnd(cycle.end));
  message.set_status(WireStatus(cycle.status));
  message.set_iterations(cycle.iterations);
  message.set_episode(cycle.episode);
  message.set_start_time_s(cycle.start_time);
  message.set_turn_time_s(cycle.turn_time);
  message.set_end_time_s(cycle.end_time);
  message.set_delta_start_m(cycle.start_deformation);
  message.set_delta_max_m(cycle.max_deformation);
  message.set_delta_end_m(cycle.end_deformation);
  message.set_approach_velocity_m_per_s(cycle.approach_velocity);
  message.set_separation_velocity_m_per_s(cycle.separation_velocity);
  message.set_mu(cycle.mu);
  message.set_mu_over_k_s_per_m(cycle.mu / contact.stiffness);
  const bool has_alpha = cycle.kind == Cycle::Kind::kCollision && !NeedsNoVelocity(contact.damping);
  message.set_alpha(has_alpha ? cycle.mu * cycle.approach_velocity / contact.stiffness : 0);
  message.set_work_compression_j(cycle.work_compression);
  message.set_work_restitution_j(cycle.work_restitution);
  message.set_dissipated_compression_j(cycle.dissipated_compression);
  message.set_dissipated_restitution_j(cycle.dissipated_restitution);
  message.set_external_work_compression_j(cycle.external_compression);
  message.set_external_work_restitution_j(cycle.external_restitution);
  message.set_restitution_in(cycle.restitution_in);
  message.set_restitution_out(cycle.restitution_out);
  message.set_peak_force_n(cycle.peak_force);
  message.set_tension_time_s(cycle.tension_time);
  message.set_identity_residual(cycle.identity_residual);
  message.set_group(cycle.group);
  if (HasNewtonRestitution(cycle)) {
    message.set_newton_restitution(-cycle.separation_velocity / cycle.approach_velocity);
  }
  return message;
}

v1::Group Encode(const Scenario& scenario, const Group& group) {
  v1::Group message;
  message.set_contact(ContactAt(scenario, group.contact).name);
  message.set_number(group.number);
  message.set_first_cycle(group.first_cycle);
  message.set_cycles(group.cycles);
  message.set_encounter(group.encounter);
  message.set_start_time_s(group.start_time);
  message.set_end_time_s(group.end_time);
  message.set_end(WireEnd(group.end));
  message.set_mu(group.mu);
  message.set_work_compression_j(group.work_compression);
  message.set_work_restitution_j(group.work_restitution);
  message.set_restitution_in(group.restitution_in);
  message.set_restitution_out(group.restitution_out);
  message.set_status(WireStatus(group.status));
  message.set_growth(WireGrowth(group.growth));
  message.set_residual(group.residual);
  message.set_beside_cut(group.beside_cut);
  if (!std::isnan(group.too_much.mu)) {
    message.set_too_much_mu(group.too_much.mu);
    message.set_too_much_restitution(group.too_much.restitution);
  }
  if (!std::isnan(group.too_little.mu)) {
    message.set_too_little_mu(group.too_little.mu);
    message.set_too_little_restitution(group.too_little.restitution);
  }
  message.mutable_other_roots()->Assign(group.other_roots.begin(), group.other_roots.end());
  return message;
}

v1::GroupGrowth EncodeGrowth(const Scenario& scenario, const Group& group) {
  v1::GroupGrowth message;
  message.set_contact(ContactAt(scenario, group.contact).name);
  message.set_encounter(group.encounter);
  message.set_first_cycle(group.first_cycle);
  message.set_cycles(group.cycles);
  message.set_start_time_s(group.start_time);
  message.set_restitution_in(group.restitution_in);
  message.set_growth(WireGrowth(group.growth));
  message.set_mu(group.mu);
  return message;
}

}  // namespace contact
