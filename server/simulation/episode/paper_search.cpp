#include "simulation/episode/paper_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contact {

bool PaperSearch::Converged(const GroupSight& g) const {
  return !g.sought || !g.ended || g.weak || !std::isfinite(g.squared) ||
         (g.squared >= 0 && std::abs(g.Miss()) <= problem_.tolerance());
}

Iteration::Update PaperSearch::Move(const GroupSight& g, Bracket& bracket) {
  Unknown& unknown = problem_.groups.At(g.id);
  unknown.corrected = true;
  const double f = g.restitution_in * g.restitution_in - g.squared;  // Paper (25).
  (f < 0 ? bracket.low : bracket.high) = g.mu;                       // Paper (26).
  if (bracket.low > 0 && bracket.high > 0) {
    unknown.mu = (bracket.low + bracket.high) / 2;  // Paper (27).
    return Iteration::Update::kBisection;
  }
  const UpdateRule rule = problem_.scenario().solver.update;
  const double newton = g.mu - f / g.frozen_slope;                      // Paper (29).
  const double ratio = g.mu * std::sqrt(g.squared) / g.restitution_in;  // Paper (31).
  if (rule == UpdateRule::kPaperNewton && newton > 0 && std::isfinite(newton)) {
    unknown.mu = newton;
    return Iteration::Update::kPaperNewton;
  }
  if (rule == UpdateRule::kPaperRatio && ratio > 0) {
    unknown.mu = ratio;
    return Iteration::Update::kPaperRatio;
  }
  unknown.mu = g.mu * (f < 0 ? 2 : 0.5);  // Where the paper has no rule.
  return Iteration::Update::kBracketing;
}

void PaperSearch::Correct(Sight& sight, int corrections) {
  for (GroupSight& g : sight.groups) {
    problem_.groups.At(g.id).iterations = corrections;
    if (!g.sought || !g.ended || g.weak) continue;
    Bracket& bracket = brackets_[g.id];
    g.update = Converged(g) ? Iteration::Update::kNothing : Move(g, bracket);
    g.bracket_low = bracket.low;
    g.bracket_high = bracket.high;
  }
}

void PaperSearch::Solve(int most_cycles, int most_corrections) {
  brackets_.clear();
  double best = std::numeric_limits<double>::infinity();
  Groups best_groups;
  for (int corrections = 0;; ++corrections) {
    Sight sight = problem_.SeeStretch(most_cycles);
    if (problem_.Aborted()) return;
    double merit = 0;
    for (const GroupSight& g : sight.groups) {
      if (!Converged(g)) merit = std::max(merit, std::abs(g.Miss()));
    }
    if (merit < best) best = merit, best_groups = problem_.groups;
    if (merit == 0 || corrections >= most_corrections) {
      problem_.groups = best_groups;
      for (const GroupSight& g : sight.groups) {  // For those that the run cuts.
        Unknown& unknown = problem_.groups.At(g.id);
        if (!g.ended) continue;
        unknown.restitution_out = std::sqrt(std::max(g.squared, 0.0));
        if (Converged(g)) unknown.status = Cycle::Status::kConverged;
      }
      log_.Accept(sight);
      return;
    }
    Correct(sight, corrections + 1);
    log_.Correct(sight);
  }
}

}  // namespace contact
