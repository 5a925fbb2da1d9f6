// The part of EpisodeSolver that takes long rows and packings piece by piece, (N6) of README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/episode.h"

namespace contact {
namespace {

constexpr int kFirstWindow = 12;  // Cycles in the first passes,
constexpr int kMoreCycles = 8;    // and how many more when these have converged.
constexpr double kFinal = 0.02;   // Change of a final μ [restitution tolerance].

}  // namespace

// The cycles that the last episode saw beginning after its end have a good μ.
void EpisodeSolver::KeepGuesses(const State& start) {
  std::erase_if(unknowns_, [&](const Unknown& u) {
    const auto contact = static_cast<std::size_t>(u.contact);
    const bool begun = u.number <= start.contacts[contact].cycles;
    return !u.corrected || begun || u.status != Cycle::Status::kNotConverged;
  });
  for (Unknown& u : unknowns_) {
    Unknown fresh;
    fresh.contact = u.contact;
    fresh.number = u.number;
    fresh.start_time = u.start_time;
    fresh.mu = fresh.best_mu = u.mu;
    fresh.start_mu = u.start_mu;
    fresh.settled_mu = u.settled_mu;
    fresh.restitution_in = u.restitution_in;
    fresh.goal = u.goal;
    fresh.iterated = fresh.corrected = fresh.seen = true;
    fresh.length = u.length;
    fresh.speed = u.speed;
    u = fresh;
  }
}

int EpisodeSolver::FirstWindow() const {
  if (as_paper_) return motion_.max_cycles();
  const int known = static_cast<int>(unknowns_.size());
  return std::min(std::max(known, kFirstWindow), motion_.max_cycles());
}

// Whether some cycles are final, so that the episode can be recorded up to the first that is not:
// they have the μ that they had when the cycles of the window before had converged.
bool EpisodeSolver::AnyFinal() {
  const double change = kFinal * scenario_.solver.restitution_tolerance;
  solved_until_ = std::numeric_limits<double>::infinity();
  for (Unknown& u : unknowns_) {
    if (!u.seen) continue;
    const double before = std::exchange(u.settled_mu, u.mu);
    const bool final = u.ended && (!u.iterated || std::abs(u.mu - before) <= change * u.mu);
    if (!final) solved_until_ = std::min(solved_until_, u.start_time);
  }
  return solved_until_ > start_time_;
}

// Takes in more cycles, if there may be more.
bool EpisodeSolver::Widen() {
  if (window_ >= motion_.max_cycles()) return false;
  window_ = std::min(window_ + kMoreCycles, motion_.max_cycles());
  guessing_ = true;
  StartAfresh();
  return true;
}

// Nothing before compares with what comes.
void EpisodeSolver::StartAfresh() {
  best_number_ = iterations_;
  best_merit_ = merit_ = std::numeric_limits<double>::infinity();
}

// Leaves the cycle alone that keeps the others from their solution. False: there is no other.
bool EpisodeSolver::GiveUpWorst() {
  if (as_paper_) return false;
  const std::vector<Unknown*> live = LiveUnknowns();
  if (live.size() < 2) return false;
  GiveUp(
      **std::ranges::max_element(live, {}, [](const Unknown* u) { return std::abs(u->residual); }));
  return true;
}

double EpisodeSolver::SolvedUntil(double until) const {
  if (solved_until_ > start_time_) return std::min(until, solved_until_);
  double solved = until;
  bool any = false;
  for (const Unknown& u : unknowns_) {
    any |= u.ended;
    if (u.seen && !u.ended) solved = std::min(solved, u.start_time);
  }
  return any && solved > start_time_ ? solved : until;
}

}  // namespace contact
