#include "simulation/run.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "simulation/episode/episode.h"
#include "simulation/episode/run_state.h"
#include "simulation/motion/cycle_works.h"
#include "simulation/sampler.h"
#include "simulation/whereabouts.h"

namespace contact {
namespace {

constexpr char kFull[] =
    "output.samples_per_contact: the trajectory has as many samples as the server allows; contacts "
    "after that have only those of sample_interval_s";

// From so many steps on a run tells what it is busy with.
constexpr std::int64_t kManySteps = 1'000'000;

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
    run_.state = InitialState(scenario_);
    sampler_.RecordStart(run_.state);
    motion_.Begin(run_.state, true);
    run_.start_energy = Energy();
    run_.start_momentum = Momentum();
    Scale();
  }

  void Restore(const RunState& from) {
    run_ = from;
    motion_.Restore(from.steps, from.evaluations);
    solver_.Restore(from);
    sampler_.Restore(from.sampling);
  }

  Outcome Run() {
    while (run_.state.time < scenario_.end_time && run_.outcome.end == Outcome::End::kFinished) {
      if (InCycle(run_.state) || solver_.Wakes(run_.state)) {
        Episode();
      } else {
        Flight();
      }
      observer_.OnProgress({.time = run_.state.time,
                            .steps = motion_.steps(),
                            .cycles = run_.cycles,
                            .iterations = solver_.log().total,
                            .busy_with = motion_.steps() < kManySteps
                                             ? std::string()
                                             : Whereabouts(scenario_, motion_)});
      if (run_.state.time < scenario_.end_time && run_.outcome.end == Outcome::End::kFinished) {
        observer_.OnBoundary([this] { return Save(); });
      }
    }
    if (run_.outcome.end == Outcome::End::kFinished) CutCycles();
    sampler_.Flush();
    if (sampler_.full()) observer_.OnWarning(kFull);
    Summarize();
    return run_.outcome;
  }

 private:
  RunState Save() const {
    RunState saved = run_;
    saved.steps = motion_.steps();
    saved.evaluations = motion_.evaluations();
    solver_.Save(&saved);
    saved.sampling = sampler_.Save();
    return saved;
  }

  Motion::Pause Advance(double until, bool repeatable) {
    motion_.Begin(run_.state, true);
    return motion_.Advance(until, solver_.Record(repeatable), &sampler_, stop_,
                           scenario_.solver.max_steps);
  }

  // To the next touch, once it is known where rests end on the way. One that ends at once begins an
  // episode instead.
  void Flight() {
    const Motion::Pause foreseen =
        solver_.Foresee(run_.state, scenario_.end_time, stop_, scenario_.solver.max_steps);
    if (foreseen != Motion::Pause::kQuiet) return Settle(foreseen);
    if (!solver_.Wakes(run_.state)) Accept(Advance(scenario_.end_time, false));
  }

  void Accept(Motion::Pause pause) {
    for (const Cycle& cycle : solver_.recorder().cycles) Emit(cycle);
    EmitGroups();
    Settle(pause);
  }

  void Episode() {
    ++run_.outcome.episodes;
    while (true) {
      const Motion::Pause solved =
          solver_.Solve(run_.state, static_cast<int>(run_.outcome.episodes), scenario_.end_time,
                        stop_, scenario_.solver.max_steps);
      if (solved != Motion::Pause::kQuiet) return Settle(solved);
      if (solver_.tentative()) sampler_.Hold();
      const Motion::Pause pause = Advance(solver_.record_until(), solver_.tentative());
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
      run_.outcome.end = end;
      run_.outcome.message = what + " at t = " + std::to_string(motion_.time()) + " s";
    };
    switch (sampler_.cut_short() ? Motion::Pause::kStopped : pause) {
      case Motion::Pause::kTimeUp:
      case Motion::Pause::kCycleStarts:
      case Motion::Pause::kQuiet:
      case Motion::Pause::kEnough:
        run_.state = motion_.Save();
        Scale();
        return;
      case Motion::Pause::kStopped:
        return fail(Outcome::End::kStopped, "stopped on request");
      case Motion::Pause::kStepLimit:
        return fail(Outcome::End::kBudgetSteps,
                    "the step budget was spent (" + Whereabouts(scenario_, motion_) + ")");
      case Motion::Pause::kNumeric:
        return fail(Outcome::End::kNumeric,
                    "the integration broke down (" + Whereabouts(scenario_, motion_) + ")");
    }
  }

  void Emit(const Cycle& cycle) {
    ++run_.cycles;
    const bool missed =
        cycle.status == Cycle::Status::kNotConverged || cycle.status == Cycle::Status::kInfeasible;
    if (missed) run_.outcome.all_converged = false;
    run_.outcome.cut_cycles +=
        cycle.status == Cycle::Status::kCut || cycle.status == Cycle::Status::kUnfinished;
    if (cycle.end != Cycle::End::kRunEnd && cycle.status != Cycle::Status::kSettled) {
      run_.outcome.worst_identity_residual =
          std::max(run_.outcome.worst_identity_residual, cycle.identity_residual);
    }
    observer_.OnCycle(cycle);
    if (missed && scenario_.solver.fail_if_not_converged &&
        run_.outcome.end == Outcome::End::kFinished) {
      run_.outcome.end = Outcome::End::kNotConverged;
      run_.outcome.message =
          "contact " + scenario_.contacts[static_cast<std::size_t>(cycle.contact)].name +
          ", cycle " + std::to_string(cycle.number) + " did not reach its restitution";
    }
  }

  // The groups that ended with the cycles just told.
  void EmitGroups() {
    for (const Group& group : solver_.recorder().groups) {
      observer_.OnGroup(group);
      if (group.status == Cycle::Status::kJump) observer_.OnWarning(TextOfJump(group));
    }
  }

  std::string TextOfJump(const Group& group) const {
    std::ostringstream text;
    text.precision(7);
    text << "contact " << scenario_.contacts[static_cast<std::size_t>(group.contact)].name
         << ", group " << group.number << ": no μ gives a restitution of " << group.restitution_in
         << "; it jumps from " << group.too_much.restitution << " at μ = " << group.too_much.mu
         << " to " << group.too_little.restitution << " at μ = " << group.too_little.mu
         << ", and has " << group.restitution_out;
    return text.str();
  }

  // Cycles that the end of the run has cut get their rows too.
  void CutCycles() {
    solver_.recorder().groups.clear();
    for (ContactState& contact : run_.state.contacts) {
      if (!InTouch(contact.phase)) continue;
      Cycle& cycle = contact.cycle;
      const double* y = motion_.integrator().y0.data();
      cycle.end = Cycle::End::kRunEnd;
      cycle.end_time = run_.state.time;
      cycle.end_deformation = -contact.gap;
      cycle.separation_velocity =
          motion_.equations().Relative(cycle.contact, y + motion_.equations().bodies());
      CloseWorks(contact);
      solver_.recorder().FinishCut(contact);
      Emit(contact.phase == Phase::kResting ? cycle : Cut(cycle));
    }
    EmitGroups();
  }

  // What the end of the run hides of a cycle is not told as if it were known.
  static Cycle Cut(Cycle cycle) {
    cycle.separation_velocity = cycle.work_restitution = cycle.dissipated_restitution =
        cycle.external_restitution = cycle.restitution_out = cycle.identity_residual = kNaN;
    if (!std::isnan(cycle.turn_time)) return cycle;
    cycle.max_deformation = cycle.peak_force = cycle.work_compression =
        cycle.dissipated_compression = cycle.external_compression = kNaN;
    return cycle;
  }

  void CloseWorks(ContactState& contact) const {
    Cycle& cycle = contact.cycle;
    const Contact& law = scenario_.contacts[static_cast<std::size_t>(cycle.contact)];
    if (contact.phase == Phase::kResting) {
      SetRest(law, run_.state.time, cycle.end_deformation, contact.work, contact.external_work,
              &cycle);
      return;
    }
    if (contact.phase == Phase::kRestitution) {
      SetRestitution(law, cycle.max_deformation, contact.work, contact.external_work, &cycle);
    } else {
      cycle.max_deformation = cycle.end_deformation;
      SetCompression(law, cycle.end_deformation, contact.work, contact.external_work, &cycle);
    }
  }

  double Energy() const { return motion_.equations().Energy(motion_.integrator().y0.data()); }
  double Momentum() const { return motion_.equations().Momentum(motion_.integrator().y0.data()); }

  // What the loads have given and taken [N·s], at most.
  double LoadImpulse() const {
    double impulse = 0;
    for (const Load& load : scenario_.loads) {
      const double t = std::max(0.0, std::min(load.end, run_.state.time) - load.begin);
      impulse += (std::abs(load.constant) + std::abs(load.amplitude)) * t +
                 0.5 * std::abs(load.slope) * t * t;
    }
    return impulse;
  }

  // The largest energy and momentum seen, to which the balances are relative.
  void Scale() {
    double momentum = 0;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (!scenario_.bodies[i].fixed) {
        momentum += scenario_.bodies[i].mass * std::abs(run_.state.velocities[i]);
      }
    }
    run_.momentum_scale = std::max({run_.momentum_scale, momentum, motion_.momentum_scale()});
    run_.energy_scale = std::max(
        {run_.energy_scale, Energy(), motion_.energy_scale(), std::abs(run_.state.load_work)});
  }

  void Summarize() {
    run_.outcome.time = run_.state.time;
    run_.outcome.positions = run_.state.positions;
    run_.outcome.velocities = run_.state.velocities;
    run_.outcome.steps = motion_.steps();
    run_.outcome.evaluations = motion_.evaluations();
    run_.outcome.iterations = solver_.log().total;
    run_.outcome.growths = solver_.log().growths;
    run_.outcome.growths_no_progress = solver_.log().growths_no_progress;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      run_.outcome.kinetic_energy +=
          0.5 * scenario_.bodies[i].mass * run_.state.velocities[i] * run_.state.velocities[i];
    }
    if (run_.outcome.end != Outcome::End::kFinished) return;
    double loss = run_.state.support_loss + run_.state.contact_loss;
    for (const ContactState& contact : run_.state.contacts) {
      // CutCycles has filled in the works of these.
      if (!InTouch(contact.phase)) continue;
      loss += contact.cycle.dissipated_compression + contact.cycle.dissipated_restitution;
    }
    if (run_.energy_scale > 0) {
      run_.outcome.energy_residual =
          std::abs(Energy() - run_.start_energy - run_.state.load_work + loss) / run_.energy_scale;
    }
    const double exchanged = std::max(run_.momentum_scale, LoadImpulse());
    if (exchanged > 0) {
      run_.outcome.momentum_residual =
          std::abs(Momentum() - run_.start_momentum - run_.state.impulse) / exchanged;
    }
  }

  const Scenario& scenario_;
  Observer& observer_;
  const std::stop_token stop_;
  Motion motion_;
  EpisodeSolver solver_;
  Sampler sampler_;
  // What a run that goes on from here needs; Save fills in what the other members hold.
  RunState run_;
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
