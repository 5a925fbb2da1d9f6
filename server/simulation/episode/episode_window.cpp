// The part of EpisodeSolver that takes long rows and packings piece by piece, (N6) of README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/episode/episode.h"
#include "simulation/episode/run_state.h"

namespace contact {
namespace {

constexpr int kFirstWindow = 12;        // Cycles in the first passes,
constexpr int kMoreCycles = 8;          // and how many more when these have converged.
constexpr double kCurvature = 0.15;     // Usual part of the product of residuals that is left.
constexpr double kFinal = 0.02;         // Change of a final μ [restitution tolerance].
constexpr double kLeastAdvance = 1e-3;  // Of what a pass sees.
constexpr double kBefore = 1e-9;  // Of the episode's length: distance of its end from a cycle.

}  // namespace

// The cycles that the last episode saw beginning after its end have a good μ.
std::vector<Guess> EpisodeSolver::Guesses(const State& end) const {
  std::vector<Guess> guesses;
  for (const Unknown& u : unknowns_) {
    const bool begun = u.number <= end.contacts[static_cast<std::size_t>(u.contact)].cycles;
    const bool infeasible = u.status == Cycle::Status::kInfeasible;
    const bool sought = infeasible || u.status == Cycle::Status::kNotConverged;
    if (begun || !u.corrected || !sought) continue;
    guesses.push_back({.contact = u.contact,
                       .number = u.number,
                       .start_time = u.start_time,
                       .mu = u.mu,
                       .start_mu = infeasible && u.mu > 0 ? u.mu : u.start_mu,
                       .settled_mu = u.settled_mu,
                       .length = u.length,
                       .speed = u.speed});
  }
  return guesses;
}

void EpisodeSolver::BeginWith(const std::vector<Guess>& guesses) {
  unknowns_.clear();
  for (const Guess& guess : guesses) {
    Unknown u = MakeUnknown(guess.contact, guess.number);
    u.start_time = guess.start_time;
    u.mu = u.best_mu = guess.mu;
    u.start_mu = guess.start_mu;
    u.settled_mu = guess.settled_mu;
    u.length = guess.length;
    u.speed = guess.speed;
    u.corrected = u.seen = true;
    unknowns_.push_back(std::move(u));
  }
}

// While one cycle lasts, about as many begin as are running.
int EpisodeSolver::FirstWindow(const State& start) const {
  if (as_paper_) return motion_.max_cycles();
  const int known = static_cast<int>(unknowns_.size());
  const auto running = static_cast<int>(std::ranges::count_if(
      start.contacts, [](const ContactState& c) { return c.phase == Phase::kRestitution; }));
  return std::min(std::max({known, kFirstWindow, running + kMoreCycles}), motion_.max_cycles());
}

// Whether some cycles are final, so that the episode can be recorded up to the first that is not:
// they have the μ that they had when the cycles of the window before had converged.
bool EpisodeSolver::AnyFinal() {
  const double change = kFinal * scenario_.solver.restitution_tolerance;
  const bool packed = std::ranges::any_of(
      unknowns_, [](const Unknown& u) { return u.seen && u.pressed && !u.weak; });
  solved_until_ = std::numeric_limits<double>::infinity();
  for (Unknown& u : unknowns_) {
    if (!u.seen) continue;
    const double before = std::exchange(u.settled_mu, u.mu);
    const bool final = u.ended && (!u.iterated || std::abs(u.mu - before) <= change * u.mu) &&
                       (!packed || Foreseen(u));
    if (!final) solved_until_ = std::min(solved_until_, u.start_time);
  }
  return Advances(solved_until_);
}

// Whether an episode that ends there would not be next to nothing.
bool EpisodeSolver::Advances(double time) const {
  return time > start_time_ && time - start_time_ > kLeastAdvance * (motion_.time() - start_time_);
}

// Takes in more cycles, if there may be more.
bool EpisodeSolver::Widen() {
  if (window_ >= motion_.max_cycles()) return false;
  whole_window_ = std::min(window_ + kMoreCycles, motion_.max_cycles());
  window_ = careful_ ? window_ + 1 : whole_window_;
  guessing_ = true;
  StartAfresh();
  return true;
}

// Nothing before compares with what comes.
void EpisodeSolver::StartAfresh() {
  best_number_ = iterations_;
  best_merit_ = merit_ = last_merit_ = std::numeric_limits<double>::infinity();
  product_ = 0;
  curvature_ = short_ ? kCurvature : 1;
}

// Leaves the cycle alone that keeps the others from their solution. False: there is no other.
bool EpisodeSolver::GiveUpWorst() {
  if (as_paper_) return false;
  const std::vector<Unknown*> live = LiveUnknowns();
  if (live.size() < (careful_ ? 1 : 2)) return false;
  GiveUp(
      **std::ranges::max_element(live, {}, [](const Unknown* u) { return std::abs(u->residual); }));
  return true;
}

// A little before the cycle begins, or round-off might let it begin with a μ that is not final.
double EpisodeSolver::Before(double cycle_start, double until) const {
  if (cycle_start >= until) return until;
  return cycle_start - kBefore * (cycle_start - start_time_);
}

double EpisodeSolver::SolvedUntil(double until) const {
  if (Advances(solved_until_)) return Before(solved_until_, until);
  // What began with the episode and outlasts the window is cut wherever that ends.
  double solved = crowded_ ? std::min(motion_.time(), until) : until;
  bool any = crowded_;
  for (const Unknown& u : unknowns_) {
    any |= u.ended;
    const bool running = u.seen && !u.ended;
    if (running && (!crowded_ || Advances(u.start_time))) solved = std::min(solved, u.start_time);
  }
  return any && Advances(solved) ? Before(solved, until) : until;
}

}  // namespace contact
