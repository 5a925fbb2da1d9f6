// The part of EpisodeSolver that takes packings cycle by cycle, (N7) and (N8) of README.md.
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/episode/episode.h"

namespace contact {
namespace {

constexpr double kFar = 0.05;  // Residual that is none of a cycle nearly solved.
constexpr double kMostMore = 8, kMostLess = 0.95;  // Relative change of its μ that it may want.
constexpr double kJump = 0.05;  // Width of a bracket in which no root is looked for.
constexpr int kDecisions = 20;  // On one cycle.
constexpr int kLooks = 3;       // Passes with natural μ.

}  // namespace

// Whether a correction of many cycles at once is out of bounds for one of a packing.
bool EpisodeSolver::Lost(const std::vector<Unknown*>& live, const Eigen::VectorXd& step) const {
  if (live.size() < 2) return false;
  for (std::size_t i = 0; i < live.size(); ++i) {
    const double relative = step[static_cast<Eigen::Index>(i)];
    if ((relative <= -0.875 || relative >= 7) && !live[i]->weak && live[i]->pressed) return true;
  }
  return false;
}

// Newton on all cycles of the window at once is lost: some have no solution, and the guesses of
// the later ones depend on the earlier. Goes back to those that are known.
void EpisodeSolver::BeCareful() {
  careful_ = true;
  looks_ = kLooks;
  whole_window_ = window_;
  known_ = 1;
  for (Unknown& u : unknowns_) {
    if (!std::isnan(u.settled_mu)) {
      u.mu = u.settled_mu;
      ++known_;
    } else {
      u.corrected = false;
      Iterate(u);
    }
  }
  jacobian_.Forget();
  damping_ = 1;
  TakeInMore();
}

// Passes through the whole window with the μ that suit the durations seen in the one before.
bool EpisodeSolver::LookAgain() {
  if (looks_ == 0) return false;
  guessing_ = true;
  if (--looks_ > 0) return true;
  window_ = std::min(known_, whole_window_);
  return true;
}

// (N7): the μ with which a contact oscillates about a load for its restitution, from a cycle seen.
double EpisodeSolver::NaturalFactor(const Contact& contact, const Cycle& cycle) {
  const double loss = -2 * std::log(contact.restitution);
  const double ratio = loss / std::hypot(M_PI, loss);  // ζ
  const double speed = 2 * M_PI / (cycle.end_time - cycle.start_time);
  const double deformation =
      (cycle.start_deformation + 2 * cycle.max_deformation + cycle.end_deformation) / 4;
  return 2 * ratio * contact.exponent * contact.stiffness / (speed * deformation);
}

// Begins anew with what the window has become.
void EpisodeSolver::TakeInMore() {
  guessing_ = true;
  StartAfresh();
  tolerance_ = coarse_;
  sensitive_ = true;
}

bool EpisodeSolver::Undecided() const {
  return std::ranges::any_of(unknowns_, [&](const Unknown& u) { return Live(u) && u.decided; });
}

// Whether all cycles were solved that overlap with a cycle in time, and those that overlap with
// these: in a packing, one that has no solution may change those before it by any amount.
bool EpisodeSolver::Foreseen(const Unknown& of) const {
  if (window_ >= motion_.max_cycles()) return true;
  double end = of.end_time;
  for (const Unknown& u : unknowns_) {
    if (u.seen && u.start_time < of.end_time) {
      if (!u.ended) return false;
      end = std::max(end, u.end_time);
    }
  }
  return std::ranges::all_of(
      unknowns_, [&](const Unknown& u) { return !u.seen || u.ended || u.start_time >= end; });
}

// Takes in one more cycle when those so far are nearly solved, until the window is whole.
bool EpisodeSolver::TakeInNext() {
  if (!careful_ || !crowded_ || window_ >= whole_window_ || Merit() > kSolved) return false;
  if (Undecided() || Revive()) return false;
  ++window_;
  TakeInMore();
  return true;
}

// Whether what was found of a cycle without solution is true no more, now that others have changed.
bool EpisodeSolver::MayBeSolved(const Unknown& u) const {
  if (!u.ended || u.iterated || !std::isfinite(u.squared)) return false;
  const double margin = Exact() ? scenario_.solver.restitution_tolerance : kSolved;
  const double miss = std::sqrt(std::max(u.squared, 0.0)) / u.restitution_in - 1;
  if (u.status == Cycle::Status::kInfeasible) return u.mu == 0 ? miss > margin : miss < -margin;
  return u.status == Cycle::Status::kNotConverged && std::abs(miss) > margin;
}

void EpisodeSolver::DeclareInfeasible(Unknown& u, double mu) {
  u.iterated = false;
  u.corrected = true;
  u.status = Cycle::Status::kInfeasible;
  u.mu = mu;
}

// Leaves those out of Newton's system that ask for what no μ, or none near, can give.
void EpisodeSolver::Decide() {
  bool any = false, left = false;
  for (Unknown& u : unknowns_) {
    u.decided = false;
    if (!Live(u)) continue;
    const bool unknown_slope = u.mu > 0 && u.column == kNone;  // It was not iterated so far.
    u.decided = unknown_slope || DecideOn(u);
    if (u.decided && ++u.decisions > kDecisions) {
      u.decided = false;
      GiveUp(u);
    }
    any |= u.decided || !u.iterated;
    left |= !u.iterated;
    if (u.decided) u.corrected = true;
  }
  if (left && short_) {  // What the brackets were found beside has changed at once.
    for (Unknown& u : unknowns_) u.low = u.high = u.low_residual = u.high_residual = 0;
  }
  if (any) best_merit_ = merit_ = std::numeric_limits<double>::infinity();
}

// Looks at how a cycle alone answers to its own μ. Whether that of the next pass is chosen here.
bool EpisodeSolver::DecideOn(Unknown& u) const {
  const bool too_much = u.residual < 0;
  const auto halve = [&] {
    u.mu = (u.low + u.high) / 2;
    u.update = Iteration::Update::kBisection;
    return true;
  };
  if (u.mu == 0) {  // Feasible after all.
    u.low = 0;
    if (!(u.high > 0)) u.high = -2 * u.residual * u.start_mu;
    return halve();
  }
  if (std::abs(u.residual) < kFar) return false;
  const double slope = u.slope * u.gradient[u.column] * u.mu;
  const double step = -u.residual / slope;
  (too_much ? u.low_residual : u.high_residual) = u.residual;
  const double next = u.mu * (1 + step);
  const bool far = u.low_residual < -kFar && u.high_residual > kFar && u.low < u.high;
  const bool good = slope > 0 && (too_much ? step < kMostMore : step > -kMostLess);
  if (good && !(far && (next <= u.low || next >= u.high))) return false;
  if (far || (u.zero_tried && u.high > u.low)) {
    if (u.high - u.low > kJump * u.high) return halve();
    DeclareInfeasible(u, u.low);  // It merges with the next cycle, or parts from it.
    return false;
  }
  if (too_much) {
    DeclareInfeasible(u, u.start_mu);
    return false;
  }
  u.zero_tried = true;
  u.high = u.mu;
  u.mu = 0;
  u.update = Iteration::Update::kZero;
  return true;
}

// Whether a cycle that Newton does not solve beside the others seems to have no solution: it jumps,
// or too little comes back. The next pass tells whether that is true: see MayBeSolved.
bool EpisodeSolver::Abandon(Unknown& u) {
  const bool jumps = u.low > 0 && std::abs(u.high - u.low) <= kJump * u.high;
  if (u.weak || (!jumps && u.residual < 0)) return false;
  DeclareInfeasible(u, jumps ? std::min(u.low, u.high) : 0);
  return true;
}

void EpisodeSolver::Iterate(Unknown& u) {
  const Contact& contact = scenario_.contacts[static_cast<std::size_t>(u.contact)];
  u.iterated = contact.damping == DampingLaw::kEnergyRestitution && contact.restitution < 1;
  if (u.iterated) u.status = Cycle::Status::kNotConverged;
  u.low = u.high = u.low_residual = u.high_residual = 0;
  u.shrinks = u.wild = u.corrections = u.decisions = 0;
  u.zero_tried = false;
}

// Iterates again the cycles that others had kept from their solution.
bool EpisodeSolver::Revive() {
  bool any = false;
  for (Unknown& u : unknowns_) {
    if (u.chances >= kChances || !MayBeSolved(u)) continue;
    ++u.chances;
    any = true;
    Iterate(u);
    Measure(u);
  }
  if (any) StartAfresh();
  return any;
}

}  // namespace contact
