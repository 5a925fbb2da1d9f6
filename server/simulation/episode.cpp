#include "simulation/episode.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace contact {
namespace {

constexpr double kForever = 1e300;
constexpr double kToldMiss = 0.01;  // Of a law's restitution, relative.
constexpr std::int64_t kStepsPerPass = 20'000;
constexpr int kPatience = 12;                 // Corrections without a better pass.
constexpr double kCoarse = 1e-7;              // Relative tolerance of the first passes, and
constexpr double kCoarseError = 1e-4;         // the residual that it may feign.
constexpr double kLeast = 1e-8, kMost = 1e8;  // Of the first guess.

std::size_t At(int index) { return static_cast<std::size_t>(index); }

// A(ε), the coefficient of the isolated collision with that restitution, is the coordinate in
// which the problem is solved: for a collision without external forces μ ↦ A(ε_out) is a straight
// line, and Newton is at its root in one step. ε is kept from 0, where A is infinite.
double Coordinate(double squared, double restitution_in) {
  return ExactCoefficient(std::max(std::sqrt(std::max(squared, 0.0)), 0.05 * restitution_in));
}

// dA/d(ε²).
double CoordinateSlope(double squared, double restitution_in) {
  const double e = std::max(std::sqrt(std::max(squared, 0.0)), 0.05 * restitution_in);
  const double a = ExactCoefficient(e);
  const double denominator = (1 - a * e) - e * e * (1 + a);
  const double slope = std::abs(1 - e) < 1e-5 ? -1.5 : a * e * (1 + a) / denominator;
  return slope / (2 * e);
}

}  // namespace

EpisodeSolver::EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer)
    : scenario_(scenario),
      as_paper_(scenario.solver.update != UpdateRule::kNewtonCoupled),
      nothing_to_find_(std::none_of(
          scenario.contacts.begin(), scenario.contacts.end(),
          [](const Contact& c) { return c.damping == DampingLaw::kEnergyRestitution; })),
      motion_(motion),
      observer_(observer),
      warned_(scenario.contacts.size()),
      missed_(static_cast<std::size_t>(DampingLaw::kGiven)) {}

Motion::Pause EpisodeSolver::Solve(const State& start, int episode, const std::stop_token& stop,
                                   std::int64_t step_limit) {
  unknowns_.clear();
  recording_ = false;
  episode_ = episode;
  iterations_ = 0;
  start_time_ = start.time;
  damping_ = 1;
  best_merit_ = merit_ = std::numeric_limits<double>::infinity();
  const SolverOptions& options = scenario_.solver;
  // A clipped force has a kink that a coarse pass may miss.
  const bool coarse = !as_paper_ && options.fixed_step == 0 && !options.clip_tension;
  tolerance_ = coarse ? std::max(kCoarse, options.relative_tolerance) : 0;
  sensitive_ = !as_paper_;
  if (nothing_to_find_) return Motion::Pause::kQuiet;
  int best_number = 0;
  while (true) {
    const Motion::Pause pause = Pass(start, stop, step_limit);
    if (pause == Motion::Pause::kNumeric && iterations_ > 0) {  // The correction led astray.
      for (Unknown& u : unknowns_) u.mu = u.best_mu;
      return Motion::Pause::kQuiet;
    }
    if (pause != Motion::Pause::kQuiet && pause != Motion::Pause::kCrowded &&
        pause != Motion::Pause::kTimeUp) {
      return pause;
    }
    const bool done = Done();
    if ((!Exact() && (done || Merit() < kCoarseError)) || (!done && !sensitive_ && !as_paper_)) {
      tolerance_ = 0;  // The same once more, exactly and with sensitivities.
      sensitive_ = true;
      continue;
    }
    const double merit = Merit();
    if (merit < best_merit_) {
      best_merit_ = merit;
      best_number = iterations_;
      for (Unknown& u : unknowns_) u.best_mu = u.mu;
    }
    // Newton that finds nothing better has failed; the paper's rules may be slow.
    const int patience = as_paper_ ? scenario_.solver.max_iterations : best_number + kPatience;
    if (done || iterations_ >= std::min(scenario_.solver.max_iterations, patience)) {
      for (Unknown& u : unknowns_) u.update = Iteration::Update::kNothing;
      Report(iterations_, start.time, true);
      if (!done) {
        for (Unknown& u : unknowns_) u.mu = u.best_mu;
      }
      return Motion::Pause::kQuiet;
    }
    as_paper_ ? CorrectAsPaper() : Correct();
    Report(iterations_, start.time, false);
    if (!as_paper_) PlanNextPass();
    ++iterations_;
    ++total_iterations_;
  }
}

bool EpisodeSolver::Done() const {
  return std::none_of(unknowns_.begin(), unknowns_.end(),
                      [&](const Unknown& u) { return Live(u) && !Converged(u); });
}

// (N5): Newton squares the residual. A pass that is not the last but one need not be exact, and
// one that is expected to be the last needs no sensitivities.
void EpisodeSolver::PlanNextPass() {
  const double wanted = scenario_.solver.restitution_tolerance;
  const double next = merit_ * merit_;
  const bool full = damping_ == 1;
  sensitive_ = !(Exact() && full && next <= 0.1 * wanted);
  if (!full || next * next <= 10 * wanted) tolerance_ = 0;
}

Motion::Pause EpisodeSolver::Pass(const State& start, const std::stop_token& stop,
                                  std::int64_t step_limit) {
  columns_ = 0;
  reference_speed_ = 0;
  for (Unknown& u : unknowns_) {
    u.ended = false;
    u.squared = kNaN;
    u.column = kNone;
  }
  motion_.Begin(start, false, tolerance_);
  const std::int64_t limit = std::min(step_limit, motion_.steps() + kStepsPerPass);
  const Motion::Pause pause = motion_.Advance(kForever, *this, nullptr, stop, limit);
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

double EpisodeSolver::SolvedUntil(double until) const {
  double solved = until;
  bool any = false;
  for (const Unknown& u : unknowns_) {
    any |= u.ended;
    if (!u.ended) solved = std::min(solved, u.start_time);
  }
  return any && solved > start_time_ ? solved : until;
}

CycleHost::Factor EpisodeSolver::OnStart(const ContactState& state, double effective_mass,
                                         double external_force) {
  const Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (state.settled) return {.mu = state.last_mu, .column = kNone};
  reference_speed_ = std::max(reference_speed_, cycle.approach_velocity);
  Unknown* u = Find(cycle.contact, cycle.number);
  if (u == nullptr) {
    Unknown made;
    made.contact = cycle.contact;
    made.number = cycle.number;
    made.mu = made.start_mu = made.best_mu = StartFactor(state, effective_mass, external_force);
    made.iterated = contact.damping == DampingLaw::kEnergyRestitution && contact.restitution < 1;
    if (contact.damping != DampingLaw::kGiven) made.restitution_in = contact.restitution;
    if (contact.damping != DampingLaw::kEnergyRestitution) {
      made.status = Cycle::Status::kGivenLaw;
    }
    unknowns_.push_back(made);
    u = &unknowns_.back();
  }
  u->pass_mu = u->mu;
  u->start_time = cycle.start_time;
  if (sensitive_ && u->iterated && u->mu > 0) u->column = columns_++;
  return {.mu = u->mu, .column = u->column, .length = u->length, .speed = u->speed};
}

// The first μ of a cycle, (N1).
double EpisodeSolver::StartFactor(const ContactState& state, double effective_mass,
                                  double external_force) {
  const Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (contact.damping == DampingLaw::kGiven) return contact.mu;
  if (NeedsNoVelocity(contact.damping)) {
    return DampingFactor(contact.damping, contact.restitution, contact.stiffness, effective_mass);
  }
  const double alpha = DampingCoefficient(contact.damping, contact.restitution);
  const double own =
      contact.reference_velocity > 0 ? contact.reference_velocity : cycle.approach_velocity;
  if (contact.damping != DampingLaw::kEnergyRestitution) {
    if (own > 0) return alpha * contact.stiffness / own;
    WarnOnce(contact,
             "has a cycle that starts at rest, for which its law has no approach "
             "velocity; it keeps the last μ (0 before the first). "
             "Give reference_velocity_m_per_s");
    return std::isnan(state.last_mu) ? 0 : state.last_mu;
  }
  if (as_paper_) return PaperStartFactor(state, contact, own);
  if (own > 0) return alpha * contact.stiffness / own;
  if (state.last_mu > 0) return state.last_mu;
  if (reference_speed_ > 0) return alpha * contact.stiffness / reference_speed_;
  // At rest under a load: the speed with which it swings through its equilibrium.
  const double depth =
      std::pow(std::max(external_force, 0.0) / contact.stiffness, 1 / contact.exponent);
  const double stiffness = contact.stiffness * Power(depth, contact.exponent).slope;
  const double speed = depth * std::sqrt(stiffness / effective_mass);
  return speed > 0 ? alpha * contact.stiffness / speed : alpha * contact.stiffness;
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
  const auto law = static_cast<std::size_t>(contact.damping);
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
  const bool weak =
      cycle.work_compression <= scenario_.solver.settled_fraction * state.largest_work;
  const bool rested = state.settled;
  state.settled = weak;
  Unknown* u = Find(cycle.contact, cycle.number);
  if (u != nullptr) {
    u->ended = true;
    if (u->length == 0) {
      u->length = length;
      u->speed = speed;
    }
    u->squared = -cycle.work_restitution / cycle.work_compression;
    u->frozen_slope = FrozenSlope(cycle);
    u->gradient =
        -(restitution_gradient + u->squared * compression_gradient) / cycle.work_compression;
    if (weak && u->iterated) {
      u->iterated = false;
      u->status = Cycle::Status::kSettled;
    }
  }
  if (!recording_) return;
  Label(cycle, rested);
  if (cycle.status == Cycle::Status::kGivenLaw && contact.damping != DampingLaw::kGiven) {
    WarnOfMiss(contact, cycle);
  }
  accepted.push_back(cycle);
}

// Writes into a cycle what became of the request for its restitution.
void EpisodeSolver::Label(Cycle& cycle, bool rested) const {
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
      cycle.iterations = u->iterated ? iterations_ : 0;
      cycle.status = u->status;
      // What the solving passes saw beyond the end of the run.
      if (cut && u->ended && u->squared >= 0 && u->mu == u->pass_mu) {
        cycle.restitution_out = std::sqrt(u->squared);
      }
    }
    const double miss = std::abs(cycle.restitution_out - cycle.restitution_in);
    if (cycle.status == Cycle::Status::kNotConverged &&
        miss <= scenario_.solver.restitution_tolerance * cycle.restitution_in) {
      cycle.status = Cycle::Status::kConverged;
    }
  }
}

void EpisodeSolver::FinishCut(const ContactState& state, Cycle& cycle) const {
  Label(cycle, state.phase == Phase::kResting);
}

bool EpisodeSolver::Converged(const Unknown& u) const {
  return u.squared >= 0 && std::abs(std::sqrt(u.squared) - u.restitution_in) <=
                               scenario_.solver.restitution_tolerance * u.restitution_in;
}

bool EpisodeSolver::Live(const Unknown& u) const {
  return u.iterated && u.ended && std::isfinite(u.squared);
}

double EpisodeSolver::Residual(const Unknown& u) const {
  return Coordinate(u.squared, u.restitution_in) /
             std::max(ExactCoefficient(u.restitution_in), 1e-6) -
         1;
}

double EpisodeSolver::Merit() const {
  double merit = 0;
  for (const Unknown& u : unknowns_) {
    if (Live(u)) merit = std::max(merit, std::abs(Residual(u)));
  }
  return merit;
}

// (N2): relative corrections of μ that bring every A(ε_out) to A(ε_in), to first order.
Eigen::VectorXd EpisodeSolver::NewtonStep(const std::vector<Unknown*>& live) const {
  const auto n = static_cast<Eigen::Index>(live.size());
  Eigen::MatrixXd jacobian(n, n);
  Eigen::VectorXd residual(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& u = *live[static_cast<std::size_t>(i)];
    const double slope = CoordinateSlope(u.squared, u.restitution_in) /
                         std::max(ExactCoefficient(u.restitution_in), 1e-6);
    residual[i] = Residual(u);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Unknown& other = *live[static_cast<std::size_t>(j)];
      const bool known = other.column != kNone && other.column < u.gradient.size();
      jacobian(i, j) = known ? slope * u.gradient[other.column] * other.mu : 0;
    }
  }
  return -jacobian.partialPivLu().solve(residual);
}

void EpisodeSolver::Correct() {
  std::vector<Unknown*> live;
  for (Unknown& u : unknowns_) {
    if (!Live(u)) continue;
    if (u.mu == 0 && std::sqrt(std::max(u.squared, 0.0)) < u.restitution_in) {
      u.iterated = false;  // Even without damping too little comes back: (N4).
      u.status = Cycle::Status::kInfeasible;
      continue;
    }
    (u.squared > u.restitution_in * u.restitution_in ? u.low : u.high) = u.mu;
    live.push_back(&u);
  }
  if (live.empty()) return;
  Eigen::VectorXd step = NewtonStep(live);
  const double merit = Merit();
  if (!step.allFinite()) {
    for (std::size_t i = 0; i < live.size(); ++i) {
      step[static_cast<Eigen::Index>(i)] = 1 / (1 + Residual(*live[i])) - 1;
    }
  }
  damping_ = merit > 2 * merit_ ? std::max(0.25 * damping_, 0.05) : std::min(1.0, 2 * damping_);
  merit_ = merit;
  for (std::size_t i = 0; i < live.size(); ++i) {
    MoveBy(*live[i], damping_ * step[static_cast<Eigen::Index>(i)], live.size() == 1);
  }
}

// (N3): keeps μ > 0, the step within a factor of 8, and, for a cycle alone, within the bracket.
void EpisodeSolver::MoveBy(Unknown& u, double relative_step, bool alone) {
  u.update = damping_ < 1 ? Iteration::Update::kDampedNewton : Iteration::Update::kNewton;
  if (u.mu == 0) {  // Feasible after all: somewhere between 0 and what was tried before.
    u.mu = (u.high > 0 ? u.high : u.start_mu) / 2;
    u.update = Iteration::Update::kBisection;
    return;
  }
  u.shrinks = relative_step <= -1 ? u.shrinks + 1 : 0;
  if (u.shrinks >= 3 && !u.zero_tried) {
    u.zero_tried = true;
    u.mu = 0;
    u.update = Iteration::Update::kZero;
    return;
  }
  double next = u.mu * std::clamp(1 + relative_step, 0.125, 8.0);
  const bool bracketed = alone && u.high > 0 && u.low < u.high && (u.low > 0 || u.zero_tried);
  if (bracketed && (next <= u.low || next >= u.high)) {
    next = (u.low + u.high) / 2;
    u.update = Iteration::Update::kBisection;
  }
  u.mu = std::clamp(next, u.start_mu * kLeast, u.start_mu * kMost);
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
