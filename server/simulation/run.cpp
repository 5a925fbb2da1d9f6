#include "simulation/run.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/episode.h"
#include "simulation/recorder.h"

namespace contact {
namespace {

// One run: free flights and episodes in turn, and the ledger.
class Runner {
 public:
  Runner(const Scenario& scenario, Observer& observer, const std::stop_token& stop)
      : scenario_(scenario),
        observer_(observer),
        stop_(stop),
        motion_(scenario),
        solver_(scenario, motion_, observer),
        recorder_(scenario, motion_, observer),
        pending_(scenario.contacts.size()) {}

  Outcome Run() {
    state_ = InitialState(scenario_);
    recorder_.RecordStart(state_);
    motion_.Begin(state_, true);
    start_energy_ = Energy();
    start_momentum_ = motion_.equations().Momentum(motion_.integrator().y0.data());
    Scale();
    while (state_.time < scenario_.end_time && outcome_.end == Outcome::End::kFinished) {
      if (InCycle(state_)) {
        Episode();
      } else {
        Settle(Advance(nullptr));
      }
      observer_.OnProgress({.time = state_.time,
                            .steps = motion_.steps(),
                            .cycles = cycles_,
                            .iterations = solver_.iterations()});
    }
    if (outcome_.end == Outcome::End::kFinished) CutCycles();
    for (auto& cycle : pending_) Emit(cycle);
    recorder_.Flush();
    Summarize();
    return outcome_;
  }

 private:
  static bool InCycle(const State& state) {
    return std::any_of(state.contacts.begin(), state.contacts.end(),
                       [](const ContactState& c) { return c.phase != Phase::kOpen; });
  }

  Motion::Pause Advance(EpisodeSolver* host) {
    motion_.Begin(state_, true);
    return motion_.Advance(scenario_.end_time, host, &recorder_, stop_, scenario_.solver.max_steps);
  }

  void Episode() {
    const Motion::Pause solved = solver_.Solve(state_, static_cast<int>(++outcome_.episodes), stop_,
                                               scenario_.solver.max_steps);
    if (solved != Motion::Pause::kQuiet) return Settle(solved);
    solver_.BeginRecording();
    Settle(Advance(&solver_));
    for (const Cycle& cycle : solver_.accepted) Accept(cycle);
  }

  // Keeps the state that the accepted trajectory has reached, and sees why it paused.
  void Settle(Motion::Pause pause) {
    const auto fail = [&](Outcome::End end, const std::string& what) {
      outcome_.end = end;
      outcome_.message = what + " at t = " + std::to_string(motion_.time()) + " s";
    };
    switch (pause) {
      case Motion::Pause::kTimeUp:
      case Motion::Pause::kCycleStarts:
      case Motion::Pause::kQuiet:
      case Motion::Pause::kCrowded:
        state_ = motion_.Save();
        Scale();
        return;
      case Motion::Pause::kStopped:
        return fail(Outcome::End::kStopped, "stopped on request");
      case Motion::Pause::kStepLimit:
        return fail(Outcome::End::kBudgetSteps, "the step budget was spent");
      case Motion::Pause::kNumeric:
        return fail(Outcome::End::kNumeric, "the integration broke down (" + Whereabouts() + ")");
    }
  }

  std::string Whereabouts() const {
    std::string names;
    for (const ActiveContact& active : motion_.equations().active) {
      const auto& contact = scenario_.contacts[static_cast<std::size_t>(active.contact)];
      names += (names.empty() ? "in contact " : ", ") + contact.name;
    }
    return names.empty() ? "no contact active" : names;
  }

  // Settled cycles that follow each other without separation are one row.
  void Accept(const Cycle& cycle) {
    auto& pending = pending_[static_cast<std::size_t>(cycle.contact)];
    if (cycle.status == Cycle::Status::kSettled) {
      if (pending) {
        Merge(cycle, &*pending);
      } else {
        pending = cycle;
      }
      if (cycle.end == Cycle::End::kSeparation) Emit(pending);
      return;
    }
    Emit(pending);
    Emit(std::optional<Cycle>(cycle));
  }

  static void Merge(const Cycle& next, Cycle* row) {
    row->end = next.end;
    row->end_time = next.end_time;
    row->end_deformation = next.end_deformation;
    row->separation_velocity = next.separation_velocity;
    row->max_deformation = std::max(row->max_deformation, next.max_deformation);
    row->work_compression += next.work_compression;
    row->work_restitution += next.work_restitution;
    row->dissipated_compression += next.dissipated_compression;
    row->dissipated_restitution += next.dissipated_restitution;
    row->external_compression += next.external_compression;
    row->external_restitution += next.external_restitution;
    row->peak_force = std::max(row->peak_force, next.peak_force);
    row->tension_time += next.tension_time;
    row->identity_residual = std::max(row->identity_residual, next.identity_residual);
    row->restitution_out = kNaN;
  }

  void Emit(std::optional<Cycle>&& cycle) { Emit(cycle); }
  void Emit(std::optional<Cycle>& cycle) {
    if (!cycle) return;
    ++cycles_;
    const bool missed = cycle->status == Cycle::Status::kNotConverged ||
                        cycle->status == Cycle::Status::kInfeasible;
    if (missed) outcome_.all_converged = false;
    const bool closed =
        cycle->end != Cycle::End::kRunEnd && cycle->status != Cycle::Status::kSettled;
    if (closed) {
      outcome_.worst_identity_residual =
          std::max(outcome_.worst_identity_residual, cycle->identity_residual);
    }
    observer_.OnCycle(*cycle);
    if (missed && scenario_.solver.fail_if_not_converged &&
        outcome_.end == Outcome::End::kFinished) {
      outcome_.end = Outcome::End::kNotConverged;
      outcome_.message =
          "contact " + scenario_.contacts[static_cast<std::size_t>(cycle->contact)].name +
          ", cycle " + std::to_string(cycle->number) + " did not reach its restitution";
    }
    cycle.reset();
  }

  // Cycles that the end of the run has cut get their rows too.
  void CutCycles() {
    for (ContactState& contact : state_.contacts) {
      if (contact.phase == Phase::kOpen || contact.phase == Phase::kStarting) continue;
      Cycle& cycle = contact.cycle;
      const double* y = motion_.integrator().y0.data();
      cycle.end = Cycle::End::kRunEnd;
      cycle.end_time = state_.time;
      cycle.end_deformation = -contact.gap;
      cycle.separation_velocity =
          motion_.equations().Relative(cycle.contact, y + motion_.equations().bodies());
      solver_.FinishCut(cycle);
      CloseWorks(contact);
      Accept(cycle);
    }
  }

  void CloseWorks(ContactState& contact) const {
    Cycle& cycle = contact.cycle;
    const Contact& law = scenario_.contacts[static_cast<std::size_t>(cycle.contact)];
    const double stored = ElasticEnergy(law, cycle.end_deformation);
    if (contact.phase == Phase::kCompression) {
      cycle.max_deformation = cycle.end_deformation;
      cycle.dissipated_compression = contact.dissipation;
      cycle.external_compression = contact.external_work;
      cycle.work_compression =
          stored - ElasticEnergy(law, cycle.start_deformation) + contact.dissipation;
    } else {
      cycle.dissipated_restitution = contact.dissipation - cycle.dissipated_compression;
      cycle.external_restitution = contact.external_work - cycle.external_compression;
      cycle.work_restitution =
          stored - ElasticEnergy(law, cycle.max_deformation) + cycle.dissipated_restitution;
    }
  }

  double Energy() const { return motion_.equations().Energy(motion_.integrator().y0.data()); }

  // The largest energy and momentum seen, to which the balances are relative.
  void Scale() {
    double momentum = 0;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (!scenario_.bodies[i].fixed) {
        momentum += scenario_.bodies[i].mass * std::abs(state_.velocities[i]);
      }
    }
    momentum_scale_ = std::max(momentum_scale_, momentum);
    energy_scale_ = std::max({energy_scale_, Energy(), std::abs(state_.load_work)});
  }

  void Summarize() {
    outcome_.time = state_.time;
    outcome_.positions = state_.positions;
    outcome_.velocities = state_.velocities;
    outcome_.steps = motion_.steps();
    outcome_.evaluations = motion_.evaluations();
    outcome_.iterations = solver_.iterations();
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      outcome_.kinetic_energy +=
          0.5 * scenario_.bodies[i].mass * state_.velocities[i] * state_.velocities[i];
    }
    if (outcome_.end != Outcome::End::kFinished) return;
    double loss = state_.support_loss + state_.contact_loss;
    for (const ContactState& contact : state_.contacts) {
      if (contact.phase != Phase::kOpen) loss += contact.dissipation;
    }
    const double momentum = motion_.equations().Momentum(motion_.integrator().y0.data());
    if (energy_scale_ > 0) {
      outcome_.energy_residual =
          std::abs(Energy() - start_energy_ - state_.load_work + loss) / energy_scale_;
    }
    if (momentum_scale_ > 0) {
      outcome_.momentum_residual =
          std::abs(momentum - start_momentum_ - state_.impulse) / momentum_scale_;
    }
  }

  const Scenario& scenario_;
  Observer& observer_;
  const std::stop_token stop_;
  Motion motion_;
  EpisodeSolver solver_;
  Recorder recorder_;
  State state_;
  Outcome outcome_;
  std::vector<std::optional<Cycle>> pending_;  // The settled row of each contact.
  std::int64_t cycles_ = 0;
  double start_energy_ = 0, start_momentum_ = 0;
  double energy_scale_ = 0, momentum_scale_ = 0;
};

}  // namespace

Outcome Run(const Scenario& scenario, Observer& observer, std::stop_token stop) {
  return Runner(scenario, observer, stop).Run();
}

}  // namespace contact
