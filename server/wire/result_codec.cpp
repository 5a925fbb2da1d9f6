#include "wire/result_codec.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "wire/column_bytes.h"
#include "wire/scenario/channels.h"

namespace contact {
namespace {

// The enum of the contract has the same value for unspecified.
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

// The number of cycles with this status.
std::int64_t CountCycles(const v1::Job& job, v1::Cycle::Status status) {
  return std::ranges::count(job.cycles(), status, &v1::Cycle::status);
}

}  // namespace

v1::Iteration Encode(const Scenario& scenario, const Iteration& iteration) {
  v1::Iteration message;
  message.set_episode(iteration.episode);
  message.set_number(iteration.number);
  message.set_start_time_s(iteration.start_time);
  message.set_accepted(iteration.accepted);
  for (const Iteration::Unknown& unknown : iteration.unknowns) {
    v1::Iteration::Unknown& out = *message.add_unknowns();
    out.set_contact(scenario.contacts[static_cast<std::size_t>(unknown.contact)].name);
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
  columns.resize(static_cast<std::size_t>(samples.columns));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i].set_values(ColumnBytes(samples.values, columns.size(), i));
    *message.add_columns() = std::move(columns[i]);
  }
  return message;
}

v1::Progress Encode(const Scenario& scenario, const Progress& progress) {
  v1::Progress message;
  message.set_time_s(progress.time);
  message.set_end_time_s(scenario.end_time);
  message.set_steps(progress.steps);
  message.set_cycles(progress.cycles);
  message.set_iterations(progress.iterations);
  message.set_busy_with(progress.busy_with);
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
  summary.set_cycles(job->cycles_size());
  summary.set_cycles_not_converged(CountCycles(*job, v1::Cycle::NOT_CONVERGED));
  summary.set_cycles_infeasible(CountCycles(*job, v1::Cycle::INFEASIBLE));
  summary.set_cycles_cut(outcome.cut_cycles);
}

}  // namespace contact
