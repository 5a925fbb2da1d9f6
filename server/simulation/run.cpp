#include "simulation/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/clusters/cluster_run.h"
#include "simulation/course/course.h"
#include "simulation/course/cut_cycles.h"
#include "simulation/course/telling.h"
#include "simulation/course/whereabouts.h"
#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/sampler.h"

namespace contact {
namespace {

// One run whose bodies all move together: free flights and episodes in turn, and the ledger.
class Runner {
 public:
  Runner(const Scenario& scenario, Observer& observer, std::stop_token stop)
      : scenario_(scenario),
        observer_(observer),
        course_(scenario, observer, stop),
        sampler_(scenario, course_.motion(), observer, std::move(stop)) {}

  void Start() {
    run_.state = InitialState(scenario_);
    sampler_.RecordStart(run_.state);
    course_.motion().Begin(run_.state, true);
    run_.start_energy = Energy() + StoredAtStart();
    run_.start_momentum = Momentum();
    Scale();
  }

  void Restore(const RunState& from) {
    run_ = from;
    course_.Restore(from);
    sampler_.Restore(from.sampling);
  }

  Outcome Run() {
    while (run_.state.time < scenario_.end_time && run_.outcome.end == Outcome::End::kFinished) {
      GoOn();
      TellProgress();
      if (run_.state.time < scenario_.end_time && run_.outcome.end == Outcome::End::kFinished) {
        observer_.OnBoundary([this] { return Save(); });
      }
    }
    if (run_.outcome.end == Outcome::End::kFinished) {
      for (const Cycle& cycle : CutCycles(scenario_, course_, &run_.state)) {
        TellCycle(scenario_, cycle, observer_, &run_);
      }
      TellGroups();
    }
    sampler_.Flush();
    if (sampler_.misses_samples()) observer_.OnWarning(kSamplesAreFull);
    Summarize();
    return run_.outcome;
  }

 private:
  RunState Save() const {
    RunState saved = run_;
    course_.Save(&saved);
    saved.sampling = sampler_.Save();
    return saved;
  }

  void GoOn() {
    const std::int64_t most = scenario_.solver.max_steps;
    const bool solves = course_.EpisodeIsNext(run_.state);
    const Course::Stretch stretch =
        solves
            ? course_.Episode(run_.state, static_cast<int>(++run_.outcome.episodes), most, sampler_)
            : course_.Flight(run_.state, scenario_.end_time, most, sampler_);
    if (stretch.recorded) {
      for (const Cycle& cycle : course_.recorder().cycles) {
        TellCycle(scenario_, cycle, observer_, &run_);
      }
      TellGroups();
    }
    Settle(stretch);
  }

  // Keeps the state that the accepted trajectory has reached, and sees why it paused.
  void Settle(const Course::Stretch& stretch) {
    const Outcome::End end = sampler_.cut_short() ? Outcome::End::kStopped : EndOf(stretch.pause);
    if (end != Outcome::End::kFinished) {
      run_.outcome.end = end;
      const Motion& motion = course_.motion();
      run_.outcome.message = WhyEnded(end, motion.time(), Whereabouts(scenario_, motion));
    } else if (stretch.recorded) {
      run_.state = course_.motion().Save();
      Scale();
    }
  }

  void TellGroups() {
    for (const Group& group : course_.recorder().groups) TellGroup(scenario_, group, observer_);
  }

  void TellProgress() {
    const Motion& motion = course_.motion();
    observer_.OnProgress({.time = run_.state.time,
                          .steps = motion.steps(),
                          .cycles = run_.cycles,
                          .iterations = course_.log().total,
                          .busy_with = BusyWith(scenario_, motion)});
  }

  // Of contacts that are pressed at t = 0, whose cycles have not begun yet.
  double StoredAtStart() const {
    double energy = 0;
    for (std::size_t c = 0; c < scenario_.contacts.size(); ++c) {
      const ContactState& state = run_.state.contacts[c];
      if (StartsPressed(state)) energy += ElasticEnergy(scenario_.contacts[c], -state.gap, 0);
    }
    return energy;
  }

  double Energy() const {
    return course_.motion().equations().Energy(course_.motion().integrator().y0.data());
  }
  double Momentum() const {
    return course_.motion().equations().Momentum(course_.motion().integrator().y0.data());
  }

  // The largest energy and momentum seen, to which the balances are relative.
  void Scale() {
    double momentum = 0;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (!scenario_.bodies[i].fixed) {
        momentum += scenario_.bodies[i].mass * std::abs(run_.state.velocities[i]);
      }
    }
    const Motion& motion = course_.motion();
    run_.momentum_scale = std::max({run_.momentum_scale, momentum, motion.momentum_scale()});
    run_.energy_scale = std::max(
        {run_.energy_scale, Energy(), motion.energy_scale(), std::abs(run_.state.load_work)});
  }

  void Summarize() {
    run_.outcome.time = run_.state.time;
    run_.outcome.positions = run_.state.positions;
    run_.outcome.velocities = run_.state.velocities;
    run_.outcome.steps = course_.motion().steps();
    run_.outcome.evaluations = course_.motion().evaluations();
    run_.outcome.iterations = course_.log().total;
    run_.outcome.growths = course_.log().growths;
    run_.outcome.growths_no_progress = course_.log().growths_no_progress;
    run_.outcome.kinetic_energy = KineticEnergy(scenario_, run_.state.velocities);
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
    const double exchanged = std::max(run_.momentum_scale, LoadImpulse(scenario_, run_.state.time));
    if (exchanged > 0) {
      run_.outcome.momentum_residual =
          std::abs(Momentum() - run_.start_momentum - run_.state.impulse) / exchanged;
    }
  }

  const Scenario& scenario_;
  Observer& observer_;
  Course course_;
  Sampler sampler_;
  // What a run that goes on from here needs; Save fills in what the other members hold.
  RunState run_;
};

}  // namespace

Outcome Run(const Scenario& scenario, Observer& observer, std::stop_token stop) {
  if (MayPart(scenario)) return ClusterRun(scenario, observer, std::move(stop)).Run();
  return RunWhole(scenario, observer, std::move(stop));
}

Outcome RunWhole(const Scenario& scenario, Observer& observer, std::stop_token stop) {
  Runner runner(scenario, observer, std::move(stop));
  runner.Start();
  return runner.Run();
}

Outcome Resume(const Scenario& scenario, const RunState& from, Observer& observer,
               std::stop_token stop) {
  if (from.clusters != nullptr) {
    ClusterRun run(scenario, observer, std::move(stop));
    run.Restore(from);
    return run.Run();
  }
  Runner runner(scenario, observer, std::move(stop));
  runner.Restore(from);
  return runner.Run();
}

}  // namespace contact
