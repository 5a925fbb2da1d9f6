// The part of EpisodeSolver that corrects μ, (N2) to (N5) of README.md.
#include <algorithm>
#include <cmath>

#include "simulation/episode/episode.h"

namespace contact {
namespace {

constexpr double kLeast = 1e-8, kMost = 1e8;  // μ, in units of the first guess.
constexpr double kLedWell = 0.3;              // Ratio of merits after a pass without sensitivities.
constexpr int kFewColumns = 4;                // They cost less than the pass that they save,
constexpr double kFar = 0.5;                  // and where the merit is more than this.
constexpr int kTrusted = 10;                  // Corrections that a short row may take.
constexpr int kWild = 6, kWildIfWeak = 3;     // Corrections out of bounds before it is given up.
constexpr double kNoise = 0.03;               // Tolerance, of what the next but one may leave.
constexpr double kHeldSamples = 4096;         // That a recording may have to take back.

}  // namespace

// A(ε), the coefficient of the isolated collision with that restitution, is the coordinate in
// which the problem is solved: for a collision without external forces μ ↦ A(ε_out) is a straight
// line, and Newton is at its root in one step. ε is kept from 0, where A is infinite.
void EpisodeSolver::Measure(Unknown& u) {
  const double e = std::max(std::sqrt(std::max(u.squared, 0.0)), 0.05 * u.restitution_in);
  const double a = ExactCoefficient(e);
  const double denominator = (1 - a * e) - e * e * (1 + a);
  const double slope = std::abs(1 - e) < 1e-5 ? -1.5 : a * e * (1 + a) / denominator;  // dA/dε
  u.residual = a / u.goal - 1;
  u.slope = slope / (2 * e) / u.goal;
}

std::vector<EpisodeSolver::Unknown*> EpisodeSolver::LiveUnknowns() {
  std::vector<Unknown*> live;
  for (Unknown& u : unknowns_) {
    if (Live(u) && !u.decided) live.push_back(&u);
  }
  return live;
}

Eigen::VectorXd EpisodeSolver::Values(const std::vector<Unknown*>& live, double Unknown::*value) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(live.size()));
  for (std::size_t i = 0; i < live.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = live[i]->*value;
  }
  return values;
}

QuasiNewton::Cycles EpisodeSolver::CyclesOf(const std::vector<Unknown*>& live) {
  QuasiNewton::Cycles cycles;
  for (const Unknown* u : live) cycles.emplace_back(u->contact, u->number);
  return cycles;
}

// Takes the Jacobian of the residuals by the relative changes of μ from the last pass.
void EpisodeSolver::Factorize(const std::vector<Unknown*>& live) {
  const auto n = static_cast<Eigen::Index>(live.size());
  if (n == 0) return jacobian_.Forget();
  Eigen::MatrixXd jacobian(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& u = *live[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      const Unknown& other = *live[static_cast<std::size_t>(j)];
      const bool known = other.column != kNone && other.column < u.gradient.size();
      jacobian(i, j) = known ? u.slope * u.gradient[other.column] * other.mu : 0;
      // Its correction is none of Newton's, or that of an isolated collision.
      if (i == j && (u.mu == 0 || u.column == kNone)) jacobian(i, j) = 1;
    }
  }
  jacobian_.Set(CyclesOf(live), Values(live, &Unknown::pass_mu), Values(live, &Unknown::residual),
                jacobian);
}

// Whether the last Jacobian may correct this pass, which has none of its own: it is of the same
// cycles, and has led well so far.
bool EpisodeSolver::FactorsServe() {
  const auto undecided = [](const Unknown& u) { return u.decided || (u.iterated && u.mu == 0); };
  if (std::ranges::any_of(unknowns_, undecided)) return false;
  return Merit() <= kLedWell * merit_ && jacobian_.IsOf(CyclesOf(LiveUnknowns()));
}

// Whether a cycle has ended of which that was not expected.
bool EpisodeSolver::LacksColumns() {
  return std::ranges::any_of(LiveUnknowns(),
                             [](const Unknown* u) { return !u->ends && u->mu > 0; });
}

// (N2): relative corrections of μ that bring every A(ε_out) to A(ε_in), to first order.
void EpisodeSolver::Correct() {
  for (Unknown& u : unknowns_) {
    if (!Live(u)) continue;
    if (u.mu == 0 && std::sqrt(std::max(u.squared, 0.0)) < u.restitution_in) {
      u.iterated = false;  // Even without damping too little comes back: (N4).
      u.status = Cycle::Status::kInfeasible;
      continue;
    }
    if (!short_ || Exact() || std::abs(u.residual) > Feigned()) {
      (u.squared > u.restitution_in * u.restitution_in ? u.low : u.high) = u.mu;
    }
  }
  doubtful_ |= short_ && iterations_ >= kTrusted;
  if (Doubts() && sensitive_) Decide();
  const std::vector<Unknown*> live = LiveUnknowns();
  if (live.empty()) return;
  const double merit = Merit();
  if (sensitive_ || !jacobian_.IsOf(CyclesOf(live))) {  // One may have been given up just now.
    Factorize(live);
  } else {
    jacobian_.Update(Values(live, &Unknown::pass_mu), Values(live, &Unknown::residual), !packing_);
  }
  Eigen::VectorXd step = jacobian_.Step();
  if (!step.allFinite()) {
    for (std::size_t i = 0; i < live.size(); ++i) {
      step[static_cast<Eigen::Index>(i)] = 1 / (1 + live[i]->residual) - 1;
    }
  }
  if (!careful_ && Lost(live, step)) return BeCareful();
  damping_ = merit > 2 * merit_ ? std::max(0.25 * damping_, 0.05) : std::min(1.0, 2 * damping_);
  if (product_ > 0) curvature_ = std::clamp(merit / product_, 0.05, 1.0);
  last_merit_ = merit_;
  merit_ = merit;
  for (std::size_t i = 0; i < live.size(); ++i) {
    MoveBy(*live[i], damping_ * step[static_cast<Eigen::Index>(i)], live.size() == 1);
  }
}

// A cycle that follows the loads around it, whatever its μ, must not keep the others from theirs.
void EpisodeSolver::GiveUp(Unknown& u) {
  if (careful_ && Abandon(u)) return;
  u.iterated = false;
  if (u.weak) u.status = Cycle::Status::kSettled;
  u.mu = u.start_mu;
}

// (N3): keeps μ > 0, the step within a factor of 8, and, for a cycle alone, within the bracket.
void EpisodeSolver::MoveBy(Unknown& u, double relative_step, bool alone) {
  u.corrected = true;
  if (std::abs(u.residual) > kSolved) ++u.corrections;
  u.update = damping_ < 1 ? Iteration::Update::kDampedNewton : Iteration::Update::kNewton;
  if (u.mu == 0) {  // Feasible after all: somewhere between 0 and what was tried before.
    u.mu = (u.high > 0 ? u.high : u.start_mu) / 2;
    u.update = Iteration::Update::kBisection;
    return;
  }
  u.shrinks = relative_step <= -1 ? u.shrinks + 1 : 0;
  if (relative_step <= -0.875 || relative_step >= 7) ++u.wild;
  if (careful_ && u.corrections > scenario_.solver.max_iterations) return GiveUp(u);
  if (u.wild >= (u.weak ? kWildIfWeak : kWild)) return GiveUp(u);
  if (u.shrinks >= 3 && !u.zero_tried && !careful_) {
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

// The next pass is with the same Jacobian, and as exact as what is left for the last one demands.
// If it is expected to converge it is exact and can be the recording, unless that might have to
// take too much back.
void EpisodeSolver::PlanLastPasses(bool converges) {
  tolerance_ = converges ? 0 : fine_;
  sensitive_ = false;
  const double interval = scenario_.sample_interval;
  const bool few = interval == 0 || motion_.time() - start_time_ < kHeldSamples * interval;
  if (converges && closed_ && few) stage_ = Stage::kExpected;
}

// (N5): a correction leaves a part, the curvature, of the product of the residual and of the one at
// which its Jacobian was taken, or last updated. A pass that is not the last but one need not be
// exact, and no Jacobian is needed for what the last one can do.
void EpisodeSolver::PlanNextPass() {
  const double wanted = scenario_.solver.restitution_tolerance;
  product_ = merit_ * (sensitive_ ? merit_ : last_merit_);
  const double next = curvature_ * product_;
  const double after = curvature_ * next * merit_;
  const bool full = damping_ == 1;
  if (full && next <= 0.5 * wanted) return PlanLastPasses(true);
  if (full && after <= wanted) return PlanLastPasses(false);
  const bool led_well = merit_ <= kLedWell * last_merit_;
  sensitive_ =
      !full || packing_ || doubtful_ || !led_well || merit_ > kFar || columns_ <= kFewColumns;
  if (!full || (!short_ && next * next <= 10 * wanted)) {
    tolerance_ = fine_;
  } else if (short_) {
    tolerance_ = std::clamp(kNoise * next * next, fine_, coarse_);
  }
}

}  // namespace contact
