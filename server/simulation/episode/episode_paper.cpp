// The part of EpisodeSolver that corrects μ as the paper does, cycle by cycle: (P1) to (P5) of
// README.md.
#include <cmath>

#include "simulation/episode/episode.h"

namespace contact {

// The first μ of a cycle: paper (23); for a NIRV cycle the last μ or paper (28).
double EpisodeSolver::PaperStartFactor(const ContactState& state, const Contact& contact,
                                       double velocity) {
  if (velocity == 0 && state.last_mu > 0) return state.last_mu;
  const double alpha = DampingCoefficient(DampingLaw::kPaperEq23, contact.restitution);
  return alpha * contact.stiffness / (velocity > 0 ? velocity : 1);
}

// Every cycle on its own; those that have converged stay as they are.
void EpisodeSolver::CorrectAsPaper() {
  for (Unknown& u : unknowns_) {
    u.update = Iteration::Update::kNothing;
    if (Live(u) && !Converged(u)) MoveAsPaper(u);
  }
}

void EpisodeSolver::MoveAsPaper(Unknown& u) const {
  u.corrected = true;
  const double f = u.restitution_in * u.restitution_in - u.squared;  // Paper (25).
  (f < 0 ? u.low : u.high) = u.mu;                                   // Paper (26).
  if (u.low > 0 && u.high > 0) {
    u.mu = (u.low + u.high) / 2;  // Paper (27).
    u.update = Iteration::Update::kBisection;
    return;
  }
  const UpdateRule rule = scenario_.solver.update;
  const double newton = u.mu - f / u.frozen_slope;                      // Paper (29).
  const double ratio = u.mu * std::sqrt(u.squared) / u.restitution_in;  // Paper (31).
  if (rule == UpdateRule::kPaperNewton && newton > 0 && std::isfinite(newton)) {
    u.mu = newton;
    u.update = Iteration::Update::kPaperNewton;
  } else if (rule == UpdateRule::kPaperRatio && ratio > 0) {
    u.mu = ratio;
    u.update = Iteration::Update::kPaperRatio;
  } else {  // Where the paper has no rule.
    u.mu *= f < 0 ? 2 : 0.5;
    u.update = Iteration::Update::kBracketing;
  }
}

// Paper (30): df/dμ along the trajectory as it is. S_c and S_r, the integrals of δⁿ δ̇ over the
// phases, are what is dissipated in them over μ.
double EpisodeSolver::FrozenSlope(const Cycle& cycle) {
  const double compression = cycle.dissipated_compression / cycle.mu;
  const double restitution = cycle.dissipated_restitution / cycle.mu;
  return (cycle.work_compression * restitution - cycle.work_restitution * compression) /
         (cycle.work_compression * cycle.work_compression);
}

}  // namespace contact
