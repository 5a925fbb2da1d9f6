#include "simulation/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/episode/episode.h"
#include "simulation/episode/run_state.h"
#include "simulation/sampler.h"

namespace contact {
namespace {

// One run: free flights and episodes in turn, and the ledger.
class Runner {
 public:
  Runner(const Scenario& scenario, Observer& observer, std::stop_token stop)
      : scenario_(scenario),
        observer_(observer),
        stop_(std::move(stop)),
        motion_(scenario),
        solver_(scenario, motion_, observer),
        sampler_(scenario, motion_, observer, stop_) {}

  void Start() {
    state_ = InitialState(scenario_);
    sampler_.RecordStart(state_);
    motion_.Begin(state_, true);
    start_energy_ = Energy();
    start_momentum_ = motion_.equations().Momentum(motion_.integrator().y0.data());
    Scale();
  }

  void Restore(const RunState& from) {
    state_ = from.state;
    outcome_ = from.outcome;
    cycles_ = from.cycles;
    start_energy_ = from.start_energy;
    start_momentum_ = from.start_momentum;
    energy_scale_ = from.energy_scale;
    momentum_scale_ = from.momentum_scale;
    motion_.Restore(from.steps, from.evaluations);
    solver_.Restore(from);
    sampler_.Restore(from.samples);
  }

  Outcome Run() {
    while (state_.time < scenario_.end_time && outcome_.end == Outcome::End::kFinished) {
      if (InCycle(state_)) {
        Episode();
      } else {
        Accept(Advance(scenario_.end_time));
      }
      observer_.OnProgress({.time = state_.time,
                            .steps = motion_.steps(),
                            .cycles = cycles_,
                            .iterations = solver_.log().total});
      if (state_.time < scenario_.end_time && outcome_.end == Outcome::End::kFinished) {
        observer_.OnBoundary([this] { return Save(); });
      }
    }
    if (outcome_.end == Outcome::End::kFinished) CutCycles();
    sampler_.Flush();
    Summarize();
    return outcome_;
  }

 private:
  RunState Save() const {
    RunState saved;
    saved.state = state_;
    saved.outcome = outcome_;
    saved.cycles = cycles_;
    saved.start_energy = start_energy_;
    saved.start_momentum = start_momentum_;
    saved.energy_scale = energy_scale_;
    saved.momentum_scale = momentum_scale_;
    saved.steps = motion_.steps();
    saved.evaluations = motion_.evaluations();
    solver_.Save(&saved);
    saved.samples = sampler_.pending();
    return saved;
  }

  Motion::Pause Advance(double until) {
    motion_.Begin(state_, true);
    return motion_.Advance(until, solver_.Record(), &sampler_, stop_, scenario_.solver.max_steps);
  }

  void Accept(Motion::Pause pause) {
    const Recorder& recorded = solver_.recorder();
    for (const Cycle& cycle : recorded.cycles) Emit(cycle);
    outcome_.groups.insert(outcome_.groups.end(), recorded.groups.begin(), recorded.groups.end());
    Settle(pause);
  }

  void Episode() {
    ++outcome_.episodes;
    while (true) {
      const Motion::Pause solved =
          solver_.Solve(state_, static_cast<int>(outcome_.episodes), scenario_.end_time, stop_,
                        scenario_.solver.max_steps);
      if (solved != Motion::Pause::kQuiet) return Settle(solved);
      if (solver_.tentative()) sampler_.Hold();
      const Motion::Pause pause = Advance(solver_.record_until());
      if (solver_.Accepts(pause)) {
        sampler_.Release();
        return Accept(pause);
      }
      sampler_.TakeBack();
    }
  }

  // Keeps the state that the accepted trajectory has reached, and sees why it paused.
  void Settle(Motion::Pause pause) {
    const auto fail = [&](Outcome::End end, const std::string& what) {
      outcome_.end = end;
      outcome_.message = what + " at t = " + std::to_string(motion_.time()) + " s";
    };
    switch (sampler_.cut_short() ? Motion::Pause::kStopped : pause) {
      case Motion::Pause::kTimeUp:
      case Motion::Pause::kCycleStarts:
      case Motion::Pause::kQuiet:
      case Motion::Pause::kEnough:
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

  void Emit(const Cycle& cycle) {
    ++cycles_;
    const bool missed =
        cycle.status == Cycle::Status::kNotConverged || cycle.status == Cycle::Status::kInfeasible;
    if (missed) outcome_.all_converged = false;
    if (cycle.end != Cycle::End::kRunEnd && cycle.status != Cycle::Status::kSettled) {
      outcome_.worst_identity_residual =
          std::max(outcome_.worst_identity_residual, cycle.identity_residual);
    }
    observer_.OnCycle(cycle);
    if (missed && scenario_.solver.fail_if_not_converged &&
        outcome_.end == Outcome::End::kFinished) {
      outcome_.end = Outcome::End::kNotConverged;
      outcome_.message =
          "contact " + scenario_.contacts[static_cast<std::size_t>(cycle.contact)].name +
          ", cycle " + std::to_string(cycle.number) + " did not reach its restitution";
    }
  }

  // Cycles that the end of the run has cut get their rows too.
  void CutCycles() {
    solver_.recorder().groups.clear();
    for (ContactState& contact : state_.contacts) {
      if (contact.phase == Phase::kOpen || contact.phase == Phase::kStarting) continue;
      Cycle& cycle = contact.cycle;
      const double* y = motion_.integrator().y0.data();
      cycle.end = Cycle::End::kRunEnd;
      cycle.end_time = state_.time;
      cycle.end_deformation = -contact.gap;
      cycle.separation_velocity =
          motion_.equations().Relative(cycle.contact, y + motion_.equations().bodies());
      solver_.recorder().FinishCut(contact);
      CloseWorks(contact);
      Emit(cycle);
    }
    const std::vector<Group>& cut = solver_.recorder().groups;
    outcome_.groups.insert(outcome_.groups.end(), cut.begin(), cut.end());
  }

  void CloseWorks(ContactState& contact) const {
    Cycle& cycle = contact.cycle;
    const Contact& law = scenario_.contacts[static_cast<std::size_t>(cycle.contact)];
    const double stored = ElasticEnergy(law, cycle.end_deformation);
    if (contact.phase != Phase::kRestitution) {
      cycle.max_deformation = cycle.end_deformation;
      cycle.work_compression = contact.work;
      cycle.external_compression = contact.external_work;
      cycle.dissipated_compression =
          contact.work - stored + ElasticEnergy(law, cycle.start_deformation);
    } else {
      cycle.work_restitution = contact.work - cycle.work_compression;
      cycle.external_restitution = contact.external_work - cycle.external_compression;
      cycle.dissipated_restitution =
          cycle.work_restitution - stored + ElasticEnergy(law, cycle.max_deformation);
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
    outcome_.iterations = solver_.log().total;
    outcome_.growths = solver_.log().growths;
    outcome_.growths_no_progress = solver_.log().growths_no_progress;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      outcome_.kinetic_energy +=
          0.5 * scenario_.bodies[i].mass * state_.velocities[i] * state_.velocities[i];
    }
    if (outcome_.end != Outcome::End::kFinished) return;
    double loss = state_.support_loss + state_.contact_loss;
    for (const ContactState& contact : state_.contacts) {  // Cut cycles; CloseWorks filled them.
      if (contact.phase == Phase::kOpen || contact.phase == Phase::kStarting) continue;
      loss += contact.cycle.dissipated_compression + contact.cycle.dissipated_restitution;
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
  Sampler sampler_;
  State state_;
  Outcome outcome_;
  std::int64_t cycles_ = 0;
  double start_energy_ = 0, start_momentum_ = 0;
  double energy_scale_ = 0, momentum_scale_ = 0;
};

}  // namespace

Outcome Run(const Scenario& scenario, Observer& observer, std::stop_token stop) {
  Runner runner(scenario, observer, std::move(stop));
  runner.Start();
  return runner.Run();
}

Outcome Resume(const Scenario& scenario, const RunState& from, Observer& observer,
               std::stop_token stop) {
  Runner runner(scenario, observer, std::move(stop));
  runner.Restore(from);
  return runner.Run();
}

}  // namespace contact
