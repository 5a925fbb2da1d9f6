#include "wire/result_codec.h"

#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace contact {
namespace {

static_assert(std::endian::native == std::endian::little, "columns are little-endian");

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
constexpr auto WireGrowth = Next<v1::Group::Growth, Growth>;
static_assert(WireGrowth(Growth::kNotGrown) == v1::Group::NOT_GROWN);
static_assert(WireGrowth(Growth::kTooLittle) == v1::Group::TOO_LITTLE);
static_assert(WireGrowth(Growth::kTooMuch) == v1::Group::TOO_MUCH);
static_assert(WireGrowth(Growth::kJump) == v1::Group::JUMP);
static_assert(WireGrowth(Growth::kNoProgress) == v1::Group::NO_PROGRESS);

// This one has a value for unspecified itself.
constexpr v1::Iteration::Update WireUpdate(Iteration::Update update) {
  return static_cast<v1::Iteration::Update>(update);
}
static_assert(WireUpdate(Iteration::Update::kNothing) == v1::Iteration::UPDATE_UNSPECIFIED);
static_assert(WireUpdate(Iteration::Update::kNewton) == v1::Iteration::NEWTON);
static_assert(WireUpdate(Iteration::Update::kDampedNewton) == v1::Iteration::DAMPED_NEWTON);
static_assert(WireUpdate(Iteration::Update::kBisection) == v1::Iteration::BISECTION);
static_assert(WireUpdate(Iteration::Update::kZero) == v1::Iteration::ZERO);
static_assert(WireUpdate(Iteration::Update::kPaperNewton) == v1::Iteration::PAPER_NEWTON);
static_assert(WireUpdate(Iteration::Update::kPaperRatio) == v1::Iteration::PAPER_RATIO);
static_assert(WireUpdate(Iteration::Update::kBracketing) == v1::Iteration::BRACKETING);

v1::FrameChunk::Column Channel(std::string_view owner, const char* quantity, const char* unit) {
  v1::FrameChunk::Column column;
  column.set_name(owner.empty() ? quantity : std::string(owner) + "." + quantity);
  column.set_quantity(quantity);
  column.set_unit(unit);
  return column;
}

// One column of the samples.
std::string ValuesOf(const Samples& samples, std::size_t column) {
  const auto rows = static_cast<std::size_t>(samples.rows());
  const auto stride = static_cast<std::size_t>(samples.columns);
  std::string bytes(rows * sizeof(double), '\0');
  for (std::size_t row = 0; row < rows; ++row) {
    std::memcpy(&bytes[row * sizeof(double)], &samples.values[row * stride + column],
                sizeof(double));
  }
  return bytes;
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
  message.set_too_much_mu(group.too_much.mu);
  message.set_too_much_restitution(group.too_much.restitution);
  message.set_too_little_mu(group.too_little.mu);
  message.set_too_little_restitution(group.too_little.restitution);
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

v1::Iteration Encode(const Scenario& scenario, const Iteration& iteration) {
  v1::Iteration message;
  message.set_episode(iteration.episode);
  message.set_number(iteration.number);
  message.set_start_time_s(iteration.start_time);
  message.set_accepted(iteration.accepted);
  for (const Iteration::Unknown& unknown : iteration.unknowns) {
    v1::Iteration::Unknown& out = *message.add_unknowns();
    out.set_contact(ContactAt(scenario, unknown.contact).name);
    out.set_number(unknown.number);
    out.set_mu(unknown.mu);
    out.set_restitution_out(unknown.restitution_out);
    out.set_restitution_in(unknown.restitution_in);
    out.set_residual(unknown.residual);
    out.set_bracket_low(unknown.bracket_low);
    out.set_bracket_high(unknown.bracket_high);
    out.set_update(WireUpdate(unknown.update));
  }
  return message;
}

v1::FrameChunk Encode(const Scenario& scenario, const Samples& samples) {
  v1::FrameChunk message;
  message.set_first_sample(samples.first);
  message.set_samples(samples.rows());
  std::vector<v1::FrameChunk::Column> columns = Channels(scenario);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    *columns[i].mutable_values() = ValuesOf(samples, i);
    *message.add_columns() = std::move(columns[i]);
  }
  return message;
}

std::vector<v1::FrameChunk::Column> Channels(const Scenario& scenario) {
  std::vector<v1::FrameChunk::Column> columns = {Channel("", "time", "s")};
  for (const Body& body : scenario.bodies) {
    columns.push_back(Channel(body.name, "position", "m"));
    columns.push_back(Channel(body.name, "velocity", "m/s"));
  }
  for (const Contact& contact : scenario.contacts) {
    columns.push_back(Channel(contact.name, "deformation", "m"));
    columns.push_back(Channel(contact.name, "deformation_velocity", "m/s"));
    columns.push_back(Channel(contact.name, "contact_force", "N"));
    columns.push_back(Channel(contact.name, "external_force", "N"));
  }
  return columns;
}

v1::Progress Encode(const Scenario& scenario, const Progress& progress) {
  v1::Progress message;
  message.set_time_s(progress.time);
  message.set_end_time_s(scenario.end_time);
  message.set_steps(progress.steps);
  message.set_cycles(progress.cycles);
  message.set_iterations(progress.iterations);
  return message;
}

void EncodeOutcome(const Scenario& scenario, const Outcome& outcome, v1::Job* job) {
  job->set_convergence(outcome.all_converged ? v1::Job::FULL : v1::Job::PARTIAL);
  job->clear_final_bodies();
  for (std::size_t i = 0; i < outcome.positions.size(); ++i) {
    v1::FinalBody& body = *job->add_final_bodies();
    body.set_name(scenario.bodies[i].name);
    body.set_position_m(outcome.positions[i]);
    body.set_velocity_m_per_s(outcome.velocities[i]);
  }
  v1::RunSummary& summary = *job->mutable_summary();
  summary.set_steps(outcome.steps);
  summary.set_evaluations(outcome.evaluations);
  summary.set_iterations(outcome.iterations);
  summary.set_episodes(outcome.episodes);
  summary.set_worst_identity_residual(outcome.worst_identity_residual);
  summary.set_momentum_residual(outcome.momentum_residual);
  summary.set_energy_residual(outcome.energy_residual);
  summary.set_kinetic_energy_j(outcome.kinetic_energy);
  summary.set_time_reached_s(outcome.time);
  summary.set_growths(outcome.growths);
  summary.set_growths_no_progress(outcome.growths_no_progress);
}

}  // namespace contact
