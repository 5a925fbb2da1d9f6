#include "simulation/episode/episode.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/episode/run_state.h"

namespace contact {
namespace {

constexpr double kForever = 1e300;
constexpr double kToldMiss = 0.01;              // Of a law's restitution, relative.
constexpr std::int64_t kStepsPerContact = 500;  // In a pass, of 10 to 40 contacts.
constexpr int kCarefulShare = 10;        // Of max_iterations, where cycles are taken in one by one.
constexpr int kPatience = 12;            // Corrections without a better pass.
constexpr double kCoarse = 1e-6;         // Relative tolerance of the first passes, and
constexpr double kFine = 0.03;           // of ξ: of the last but one;
constexpr double kShortCoarse = 3e-4;    // the same for
constexpr double kShortFine = 0.5;       // short rows,
constexpr std::size_t kShort = 12;       // of so many contacts at most.
constexpr std::size_t kFewContacts = 4;  // Whose first pass has sensitivities.
constexpr double kNear = 0.02;           // A merit at which the guesses are left alone.
constexpr double kPressed = 1e-3;        // Elastic energy at a start, of a contact's largest W_c.
constexpr double kWeak = 1e-5;           // W_c of a contact's largest.
constexpr double kLeastGoal = 1e-6;      // A(ε_in) to which residuals are relative.

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

EpisodeSolver::EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer)
    : scenario_(scenario),
      as_paper_(scenario.solver.update != UpdateRule::kNewtonCoupled),
      nothing_to_find_(std::none_of(
          scenario.contacts.begin(), scenario.contacts.end(),
          [](const Contact& c) { return c.damping == DampingLaw::kEnergyRestitution; })),
      packing_(IsPacking(scenario)),
      short_(!packing_ && scenario.contacts.size() <= kShort),
      motion_(motion),
      observer_(observer),
      warned_(scenario.contacts.size()),
      missed_(kDampingLaws) {}

void EpisodeSolver::Begin(const State& start, int episode, double until) {
  BeginWith(Guesses(start));
  jacobian_.Forget();
  recording_ = false;
  doubtful_ = false;
  episode_ = episode;
  iterations_ = best_number_ = 0;
  start_time_ = start.time;
  until_ = until;
  damping_ = 1;
  solved_until_ = start.time;
  guessing_ = true;
  StartAfresh();
  const SolverOptions& options = scenario_.solver;
  // A clipped force has a kink that a coarse pass may miss.
  const bool coarse = !as_paper_ && options.fixed_step == 0 && !options.clip_tension;
  coarse_ = tolerance_ =
      coarse ? std::max(short_ ? kShortCoarse : kCoarse, options.relative_tolerance) : 0;
  const double fine = (short_ ? kShortFine : kFine) * options.restitution_tolerance;
  fine_ = coarse ? std::clamp(fine, options.relative_tolerance, tolerance_) : 0;
  // Of many cycles it is not known yet which end, and so have a μ to be found.
  sensitive_ = !as_paper_ && (packing_ || scenario_.contacts.size() <= kFewContacts);
  again_ = false;
  careful_ = false;
  looks_ = 0;
  natural_.assign(scenario_.contacts.size(), kNaN);
  window_ = FirstWindow(start);
  stage_ = nothing_to_find_ ? Stage::kSolved : Stage::kSolving;
}

void EpisodeSolver::Save(RunState* state) const {
  state->iterations = total_iterations_;
  state->warned = warned_;
  state->missed = missed_;
  state->guesses = Guesses(state->state);
}

void EpisodeSolver::Restore(const RunState& state) {
  episode_ = static_cast<int>(state.outcome.episodes);  // Of cycles that rest after it.
  total_iterations_ = state.iterations;
  warned_ = state.warned;
  missed_ = state.missed;
  BeginWith(state.guesses);
}

Motion::Pause EpisodeSolver::Solve(const State& start, const std::stop_token& stop,
                                   std::int64_t step_limit) {
  while (stage_ != Stage::kSolved) {
    if (stage_ == Stage::kSolving) {
      const Motion::Pause pause = Pass(start, stop, step_limit);
      if (pause == Motion::Pause::kNumeric && iterations_ > 0) {  // The correction led astray.
        UseBest();
        break;
      }
      if (pause != Motion::Pause::kQuiet && pause != Motion::Pause::kCrowded &&
          pause != Motion::Pause::kTimeUp) {
        return pause;
      }
      crowded_ = pause == Motion::Pause::kCrowded;
      closed_ = pause == Motion::Pause::kQuiet && motion_.time() < until_;
    }
    stage_ = Stage::kSolving;
    NextPass();
    if (stage_ == Stage::kExpected) break;
  }
  return Motion::Pause::kQuiet;
}

bool EpisodeSolver::Accepts(Motion::Pause recorded) {
  if (stage_ != Stage::kExpected) return true;
  if (recorded == Motion::Pause::kStopped || recorded == Motion::Pause::kStepLimit) return true;
  recording_ = false;
  if (recorded == Motion::Pause::kNumeric) UseBest();
  if (recorded == Motion::Pause::kQuiet && Done()) {
    Finish();
    return true;
  }
  fine_ = 0;  // Else a fine pass may be content again with what this one was not.
  return false;
}

void EpisodeSolver::BeginRecording() {
  recording_ = true;
  accepted.clear();
  if (stage_ == Stage::kExpected) ForgetPass();
}

// Looks at the pass that has been, and decides on the next.
void EpisodeSolver::NextPass() {
  if (LookAgain() || TakeInNext()) return;
  const bool done = Done() && !(Doubts() && Revive());
  if (!Exact() && (done || (tolerance_ > fine_ && Merit() < Feigned()))) {
    // The same once more, exactly.
    if (sensitive_) Factorize(LiveUnknowns());
    PlanLastPasses(done);
    return;
  }
  again_ = !done && !as_paper_ && !again_ && (sensitive_ ? LacksColumns() : !FactorsServe());
  if (again_) {
    // The same once more, with sensitivities; not so coarse that it is content with what this
    // pass was not.
    if (!sensitive_ && Exact() && packing_) fine_ = 0;
    tolerance_ = std::max(tolerance_, fine_);
    sensitive_ = true;
    return;
  }
  KeepBest();
  if (done && crowded_ && !AnyFinal() && Widen()) return;
  // Newton that finds nothing better has failed; the paper's rules may be slow.
  const int most = scenario_.solver.max_iterations * (careful_ ? kCarefulShare : 1);
  const int patience = as_paper_ ? most : best_number_ + kPatience;
  const bool stuck = iterations_ >= patience && iterations_ < most;
  if (!done && stuck && GiveUpWorst()) {
    StartAfresh();
  } else if (done || iterations_ >= std::min(most, patience)) {
    Finish();
    if (!done) UseBest();
    return;
  }
  as_paper_ ? CorrectAsPaper() : Correct();
  Report(iterations_, start_time_, false);
  if (!as_paper_) PlanNextPass();
  ++iterations_;
  ++total_iterations_;
}

void EpisodeSolver::KeepBest() {
  const double merit = Merit();
  if (merit >= best_merit_) return;
  best_merit_ = merit;
  best_number_ = iterations_;
  for (Unknown& u : unknowns_) u.best_mu = u.mu;
}

void EpisodeSolver::UseBest() {
  for (Unknown& u : unknowns_) u.mu = u.best_mu;
  stage_ = Stage::kSolved;
}

void EpisodeSolver::Finish() {
  for (Unknown& u : unknowns_) u.update = Iteration::Update::kNothing;
  Report(iterations_, start_time_, true);
  stage_ = Stage::kSolved;
}

bool EpisodeSolver::Done() const {
  return std::none_of(unknowns_.begin(), unknowns_.end(),
                      [&](const Unknown& u) { return Live(u) && !Converged(u); });
}

void EpisodeSolver::ForgetPass() {
  guessing_ |= Merit() > kNear;
  columns_ = 0;
  reference_speed_ = 0;
  for (Unknown& u : unknowns_) {
    if (!u.seen && u.iterated) {  // A phantom; should it come back, it begins anew.
      u.corrected = false;
      u.low = u.high = 0;
      u.shrinks = u.wild = 0;
    }
    if (u.seen && !packing_) u.ends = u.ended;
    u.seen = u.ended = false;
    u.squared = u.residual = kNaN;
    u.column = kNone;
  }
}

Motion::Pause EpisodeSolver::Pass(const State& start, const std::stop_token& stop,
                                  std::int64_t step_limit) {
  ForgetPass();
  motion_.Begin(start, false, tolerance_, window_);
  const auto contacts = static_cast<std::int64_t>(scenario_.contacts.size());
  const std::int64_t most = kStepsPerContact * std::clamp<std::int64_t>(contacts, 10, 40);
  const std::int64_t limit = std::min(step_limit, motion_.steps() + most);
  const Motion::Pause pause = motion_.Advance(kForever, *this, nullptr, stop, limit);
  guessing_ = false;
  // A contact at rest may never end its cycle; what has ended can still be solved.
  if (pause == Motion::Pause::kStepLimit && limit < step_limit) return Motion::Pause::kTimeUp;
  return pause;
}

EpisodeSolver::Unknown* EpisodeSolver::Find(int contact, int number) {
  for (Unknown& u : unknowns_) {
    if (u.contact == contact && u.number == number) return &u;
  }
  return nullptr;
}

const EpisodeSolver::Unknown* EpisodeSolver::Find(int contact, int number) const {
  return const_cast<EpisodeSolver*>(this)->Find(contact, number);
}

EpisodeSolver::Unknown EpisodeSolver::MakeUnknown(int index, int number) const {
  const Contact& contact = scenario_.contacts[At(index)];
  Unknown made;
  made.contact = index;
  made.number = number;
  made.iterated = contact.damping == DampingLaw::kEnergyRestitution && contact.restitution < 1;
  if (contact.damping != DampingLaw::kGiven) made.restitution_in = contact.restitution;
  if (made.iterated) made.goal = std::max(ExactCoefficient(contact.restitution), kLeastGoal);
  if (contact.damping != DampingLaw::kEnergyRestitution) made.status = Cycle::Status::kGivenLaw;
  return made;
}

CycleHost::Factor EpisodeSolver::OnStart(const ContactState& state, double effective_mass,
                                         double external_force) {
  const Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (state.settled) return {.mu = state.last_mu, .column = kNone};
  reference_speed_ = std::max(reference_speed_, cycle.approach_velocity);
  Unknown* u = Find(cycle.contact, cycle.number);
  if (u == nullptr) {
    unknowns_.push_back(MakeUnknown(cycle.contact, cycle.number));
    u = &unknowns_.back();
  }
  u->seen = true;
  const bool law = contact.damping != DampingLaw::kEnergyRestitution;
  if (law || (!u->corrected && (guessing_ || u->start_mu == 0))) {
    u->mu = u->start_mu = u->best_mu = FirstFactor(*u, state, effective_mass, external_force);
  }
  u->pressed =
      packing_ && ElasticEnergy(contact, cycle.start_deformation) > kPressed * state.largest_work;
  u->pass_mu = u->mu;
  u->start_time = cycle.start_time;
  if (sensitive_ && u->iterated && u->ends && u->mu > 0) u->column = columns_++;
  return {.mu = u->mu, .column = u->column, .length = u->length, .speed = u->speed};
}

void EpisodeSolver::OnCancel(const ContactState& state) {
  Unknown* u = Find(state.cycle.contact, state.cycle.number);
  if (u != nullptr) u->seen = false;
}

void EpisodeSolver::WarnOnce(const Contact& contact, const std::string& text) {
  const auto index = static_cast<std::size_t>(&contact - scenario_.contacts.data());
  if (warned_[index]) return;
  warned_[index] = true;
  observer_.OnWarning("contact " + contact.name + " " + text);
}

// Says once for each law that it does not deliver what was asked of it.
void EpisodeSolver::WarnOfMiss(const Contact& contact, const Cycle& cycle) {
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

void EpisodeSolver::OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
                          const Eigen::ArrayXd& restitution_gradient, double length, double speed) {
  Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  const bool weak = IsWeak(state);
  const bool rested = state.settled;
  state.settled = weak;
  Unknown* u = rested ? nullptr : Find(cycle.contact, cycle.number);
  if (u != nullptr) {
    u->ended = true;
    u->end_time = cycle.end_time;
    if (u->length == 0) {
      u->length = length;
      u->speed = speed;
    }
    u->squared = -cycle.work_restitution / cycle.work_compression;
    u->frozen_slope = FrozenSlope(cycle);
    if (u->iterated && std::isfinite(u->squared)) Measure(*u);
    u->gradient =
        -(restitution_gradient + u->squared * compression_gradient) / cycle.work_compression;
    u->weak = cycle.work_compression <= kWeak * state.largest_work;
    if (u->iterated && !u->weak) {
      u->natural_mu = natural_[At(cycle.contact)] = NaturalFactor(contact, cycle);
    }
    if (weak && u->iterated) {
      u->iterated = false;
      u->status = Cycle::Status::kSettled;
    } else if (careful_ && !weak && !u->weak && u->status == Cycle::Status::kSettled &&
               u->chances < kChances) {
      ++u->chances;
      u->iterated = true;  // It was weak only as long as the others were wrong.
      u->status = Cycle::Status::kNotConverged;
      if (std::isfinite(u->squared)) Measure(*u);
    }
  }
  if (!recording_) return;
  Label(cycle, rested, weak);
  if (cycle.status == Cycle::Status::kGivenLaw && contact.damping != DampingLaw::kGiven) {
    WarnOfMiss(contact, cycle);
  }
  accepted.push_back(cycle);
}

bool EpisodeSolver::IsWeak(const ContactState& state) const {
  const SolverOptions& options = scenario_.solver;
  const double fraction = state.cycle.kind == Cycle::Kind::kNirv ? options.settled_nirv_fraction
                                                                 : options.settled_fraction;
  return state.cycle.work_compression <= fraction * state.largest_work;
}

// Writes into a cycle what became of the request for its restitution.
void EpisodeSolver::Label(Cycle& cycle, bool rested, bool weak) const {
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  const Unknown* u = Find(cycle.contact, cycle.number);
  cycle.episode = episode_;
  if (contact.damping != DampingLaw::kGiven) cycle.restitution_in = contact.restitution;
  if (rested) {
    cycle.status = Cycle::Status::kSettled;
    cycle.restitution_out = kNaN;
  } else if (contact.damping != DampingLaw::kEnergyRestitution) {
    cycle.status = Cycle::Status::kGivenLaw;
  } else {
    const bool cut = cycle.end == Cycle::End::kRunEnd;
    if (u != nullptr) {
      cycle.iterations = Corrections(*u);
      cycle.status = u->status;
      // What the solving passes saw beyond the end of the run.
      if (cut && u->ended && u->squared >= 0 && u->mu == u->pass_mu) {
        cycle.restitution_out = std::sqrt(u->squared);
      }
    }
    const bool too_much = cycle.restitution_out > cycle.restitution_in;
    if (cycle.status == Cycle::Status::kInfeasible && too_much == (cycle.mu == 0)) {
      cycle.status = Cycle::Status::kNotConverged;  // The others have changed since.
    }
    const double miss = std::abs(cycle.restitution_out - cycle.restitution_in);
    if (cycle.status == Cycle::Status::kNotConverged &&
        miss <= scenario_.solver.restitution_tolerance * cycle.restitution_in) {
      cycle.status = Cycle::Status::kConverged;
    }
    if (cycle.status == Cycle::Status::kNotConverged && weak && (u == nullptr || !u->ended)) {
      cycle.status = Cycle::Status::kSettled;  // It began before this episode, or ends after it.
    }
  }
}

// The next episode does not know them: their μ is no unknown of it.
void EpisodeSolver::HandOver(std::vector<ContactState>& contacts) const {
  for (ContactState& state : contacts) {
    const bool runs = state.phase == Phase::kCompression || state.phase == Phase::kRestitution;
    Cycle& cycle = state.cycle;
    const Unknown* u = runs ? Find(cycle.contact, cycle.number) : nullptr;
    if (u == nullptr) continue;
    cycle.status = u->status;
    cycle.iterations = Corrections(*u);
    const bool known = u->ended && u->squared >= 0 && u->mu == u->pass_mu;
    if (known) cycle.restitution_out = std::sqrt(u->squared);
  }
}

int EpisodeSolver::Corrections(const Unknown& u) const {
  if (!u.iterated) return 0;
  return careful_ ? u.corrections : iterations_;
}

void EpisodeSolver::FinishCut(const ContactState& state, Cycle& cycle) const {
  const bool turned = state.phase == Phase::kRestitution;
  Label(cycle, state.phase == Phase::kResting, turned && IsWeak(state));
}

bool EpisodeSolver::Converged(const Unknown& u) const {
  return u.squared >= 0 && std::abs(std::sqrt(u.squared) - u.restitution_in) <=
                               scenario_.solver.restitution_tolerance * u.restitution_in;
}

bool EpisodeSolver::Live(const Unknown& u) const {
  return u.iterated && u.ended && std::isfinite(u.squared);
}

// Weak cycles do not tell whether a correction was good: they come and go with it.
double EpisodeSolver::Merit() const {
  double merit = 0, weak = 0;
  bool strong = false;
  for (const Unknown& u : unknowns_) {
    if (!Live(u)) continue;
    strong |= !u.weak;
    double& worst = u.weak ? weak : merit;
    worst = std::max(worst, std::abs(u.residual));
  }
  return strong ? merit : weak;
}

void EpisodeSolver::Report(int number, double time, bool accepted_pass) {
  Iteration iteration;
  iteration.episode = episode_;
  iteration.number = number;
  iteration.start_time = time;
  iteration.accepted = accepted_pass;
  for (const Unknown& u : unknowns_) {
    iteration.unknowns.push_back({.contact = u.contact,
                                  .number = u.number,
                                  .mu = u.pass_mu,
                                  .restitution_out = u.squared >= 0 ? std::sqrt(u.squared) : kNaN,
                                  .restitution_in = u.restitution_in,
                                  .residual = u.restitution_in * u.restitution_in - u.squared,
                                  .bracket_low = u.low,
                                  .bracket_high = u.high,
                                  .update = u.update});
  }
  observer_.OnIteration(iteration);
}

}  // namespace contact
