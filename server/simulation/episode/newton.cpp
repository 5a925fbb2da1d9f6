#include "simulation/episode/newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/episode/front.h"

namespace contact {
namespace {

// A step is shortened by this factor while it does not make the merit fall enough,
constexpr double kShorter = 0.35;
// so often at most: 1.5 % of a Newton step that does not help is no descent worth its passes.
constexpr int kShortenings = 5;
// Part of the fall of the merit expected by the slope that a step must bring.
constexpr double kFall = 0.3;
// Relative change of a μ in one step: further off the slopes tell nothing.
constexpr double kLeast = -0.8, kMost = 4;
// Residual of a group that does not end with a trial μ: worse than any that does.
constexpr double kOpen = 10;
// Error that a pass may have, in units of the miss that is expected of it. A step that works has
// an error some 10 times the tolerance.
constexpr double kMissNoise = 1e-3;
// A miss below which the last Jacobian, updated, leads as well as a true one, for less where there
// are more than a few unknowns.
constexpr double kNearRoot = 0.01;
constexpr std::size_t kFewUnknowns = 4;
// Where the merit falls to this part they lead on, too.
constexpr double kLeap = 0.1;
// Part of the goal below which a miss that is expected is none.
constexpr double kSure = 0.1;
// The curvature that is expected before it was seen.
constexpr double kCurved = 1;
// In so many corrections the merit has to fall by this factor: else the method only creeps.
constexpr int kPace = 5;
constexpr double kHeadway = 0.5;
// Two steps in a row of less than this part lead to a jump, not to a root.
constexpr double kCreep = 0.2;
// A miss that may be the error of a coarse pass.
constexpr double kBlurred = 1e-2;
// How much longer than before a trial may last, in spans of the front.
constexpr double kLonger = 4;

}  // namespace

double Newton::Horizon(const std::vector<GroupId>& front, const Sight& sight) const {
  double start = kForever, end = 0;
  for (const GroupId& id : front) {
    const GroupSight* g = sight.Find(id);
    if (g == nullptr || !g->ended) continue;
    start = std::min(start, g->start_time);
    end = std::max(end, g->end_time);
  }
  return end > start ? end + kLonger * (end - start) : kForever;
}

double Newton::Merit(const std::vector<GroupId>& front, const Sight& sight) const {
  double merit = 0;
  for (const GroupId& id : front) {
    const GroupSight* g = sight.Find(id);
    if (g == nullptr) continue;
    const double r = g->ended ? g->residual : kOpen;
    merit += std::isfinite(r) ? r * r : kOpen * kOpen;
  }
  return merit;
}

// The largest miss of the front; infinite if one does not end.
double Newton::Worst(const std::vector<GroupId>& front, const Sight& sight) const {
  double worst = 0;
  for (const GroupId& id : front) {
    const GroupSight* g = sight.Find(id);
    if (g == nullptr || g->weak) continue;
    worst = std::max(worst, g->ended && std::isfinite(g->squared) ? std::abs(g->Miss()) : kForever);
  }
  return worst;
}

// Whether what a scan has seen of a front counts as negligible in a coarse pass.
bool Newton::Overlooks(const std::vector<GroupId>& front, const Sight& sight) const {
  return std::ranges::any_of(front, [&](const GroupId& id) {
    const GroupSight* g = sight.Find(id);
    return g != nullptr && g->weak && !problem_.groups.At(id).weak;
  });
}

// A pass as exact as the miss that is expected of it demands.
Sight Newton::Look(const std::vector<GroupId>& front, bool sensitive, double expected,
                   double horizon) {
  // The last correction rests on the pass before it, which must be as exact as the goal.
  const bool last = curvature_ * expected * expected <= kSure * goal_;
  const bool exact = goal_ <= problem_.tolerance() && last;
  bool coarse = !exact && (coarse_ || expected > kBlurred);
  const double tolerance = coarse ? kMissNoise * (last ? goal_ : std::max(expected, goal_)) : 0;
  Sight sight = problem_.Evaluate(front, sensitive, horizon, tolerance);
  if (coarse && Overlooks(front, sight)) {
    coarse = false;
    sight = problem_.Evaluate(front, sensitive, horizon);
  }
  sight.exact = last || !coarse;
  return sight;
}

// Of groups that were not seen to their ends 0: they are not to be moved.
Eigen::VectorXd Newton::Residuals(const std::vector<GroupId>& front, const Sight& sight) {
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(front.size()));
  for (std::size_t i = 0; i < front.size(); ++i) {
    const GroupSight* g = sight.Find(front[i]);
    const bool known = g != nullptr && g->ended && g->mu > 0 && std::isfinite(g->residual);
    if (known) residuals[static_cast<Eigen::Index>(i)] = g->residual;
  }
  return residuals;
}

// Takes the true Jacobian of a pass with sensitivities.
void Newton::Take(const std::vector<GroupId>& front, const Sight& sight) {
  const auto n = static_cast<Eigen::Index>(front.size());
  jacobian_ = Eigen::MatrixXd::Identity(n, n);
  residual_ = Residuals(front, sight);
  true_ = true;
  for (Eigen::Index i = 0; i < n; ++i) {
    const GroupSight* g = sight.Find(front[static_cast<std::size_t>(i)]);
    if (g == nullptr || !g->ended || g->column == kNone || !std::isfinite(g->residual)) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      const GroupSight* other = sight.Find(front[static_cast<std::size_t>(j)]);
      const bool known =
          other != nullptr && other->column != kNone && other->column < g->gradient.size();
      jacobian_(i, j) = known ? g->gradient[other->column] * other->mu : 0;
    }
  }
}

// Broyden's update by what a step has shown; from a tangent on the residuals are a parabola along
// the step, of which the tangent's miss is half of what the slope has changed by. Source: Broyden,
// A class of methods for solving nonlinear simultaneous equations, Math. Comp. 19 (1965), method 1.
void Newton::Learn(const std::vector<GroupId>& front, const Sight& sight,
                   const Eigen::VectorXd& step) {
  const Eigen::VectorXd after = Residuals(front, sight);
  const Eigen::VectorXd miss = after - residual_ - jacobian_ * step;
  if (const double square = step.squaredNorm(); square > 0) {
    jacobian_ += (true_ ? 2 : 1) / square * miss * step.transpose();
  }
  residual_ = after;
  true_ = false;
}

// Changes of ln μ that bring every residual to 0, to first order.
Eigen::VectorXd Newton::Step() const {
  const Eigen::VectorXd step = -jacobian_.partialPivLu().solve(residual_);
  return step.allFinite() ? step : Eigen::VectorXd(-residual_);
}

void Newton::Move(const std::vector<GroupId>& front, const Sight& from,
                  const Eigen::VectorXd& step) {
  for (std::size_t i = 0; i < front.size(); ++i) {
    const GroupSight* g = from.Find(front[i]);
    if (g == nullptr) continue;
    Unknown& unknown = problem_.groups.At(front[i]);
    unknown.corrected = true;
    const double mu = g->mu * (1 + std::clamp(step[static_cast<Eigen::Index>(i)], kLeast, kMost));
    unknown.mu = g->ended ? std::min(mu, std::max(g->mu, problem_.MostMu(*g))) : mu;
  }
}

void Newton::Count(const std::vector<GroupId>& front, Sight& sight, int corrections, bool damped) {
  for (GroupSight& g : sight.groups) {
    if (std::ranges::find(front, g.id) == front.end()) continue;
    g.update = damped ? Iteration::Update::kDampedNewton : Iteration::Update::kNewton;
    problem_.groups.At(g.id).iterations = corrections;
  }
  log_.Correct(sight);
}

// The miss that a whole step leaves.
double Newton::Expected(double worst) const {
  return true_ ? std::min(worst, curvature_ * worst * worst) : worst;
}

Found Newton::Solve(const std::vector<GroupId>& front, double goal, int most_corrections,
                    bool coarse, const Sight& seen) {
  goal_ = goal;
  coarse_ = coarse;
  curvature_ = kCurved;
  suspect_.clear();
  creeps_ = 0;
  sinks_ = Mask::Constant(static_cast<Eigen::Index>(front.size()), false);
  Sight now = seen.exact ? Look(front, true, Worst(front, seen), kForever) : seen;
  Take(front, now);
  double merit = kForever;
  for (corrections_ = 0;; ++corrections_) {
    if (problem_.Aborted()) return Found::kAborted;
    if (now.pause == Motion::Pause::kNumeric) return Found::kStalled;
    if (Worst(front, now) <= goal) return Found::kSolved;
    if (corrections_ >= most_corrections) return Found::kLimit;
    if (creeps_ > 1) return Found::kStalled;
    if (corrections_ % kPace == 0) {
      const double before = std::exchange(merit, Merit(front, now));
      if (merit > kHeadway * before) return Found::kStalled;
    }
    if (coarse && now.exact && Expected(Worst(front, now)) <= kSure * goal) {
      Move(front, now, Step());
      Count(front, now, ++corrections_, false);
      return Found::kSolved;
    }
    const Found moved = Correct(front, now);
    const bool blurred = !now.exact && Worst(front, now) <= kBlurred;
    if (moved == Found::kStalled && (!true_ || blurred)) {  // A better Jacobian may do better.
      now = Look(front, true, blurred ? goal : Worst(front, now), kForever);
      Take(front, now);
    } else if (moved != Found::kSolved) {
      return moved;
    }
  }
}

// Whether tangents lead to μ < 0 of a group twice in a row.
bool Newton::Sinks(const std::vector<GroupId>& front, const Eigen::VectorXd& step) {
  const Mask before = std::exchange(sinks_, step.array() <= -1);
  Eigen::Index first = 0;
  if (!(before && sinks_).maxCoeff(&first)) return false;
  suspect_ = {front[static_cast<std::size_t>(first)]};
  return true;
}

// No step has helped: it may be for the group that misses most in the last trial.
void Newton::Suspect(const std::vector<GroupId>& front, const Sight& trial) {
  const auto miss = [&](const GroupId& id) {
    const GroupSight* g = trial.Find(id);
    return g == nullptr                             ? 0
           : g->ended && std::isfinite(g->residual) ? std::abs(g->residual)
                                                    : kOpen;
  };
  suspect_ = {*std::ranges::max_element(front, {}, miss)};
}

// One correction, shortened until the merit falls enough. Slopes are for steps that are taken: most
// that are shortened are not, and of many unknowns a pass with slopes costs many passes without.
Found Newton::Correct(const std::vector<GroupId>& front, Sight& now) {
  const Eigen::VectorXd step = Step();
  if (Sinks(front, step)) return Found::kStalled;
  const double worst = Worst(front, now), merit = Merit(front, now), horizon = Horizon(front, now);
  const bool few = front.size() <= kFewUnknowns, near = worst < kNearRoot && !few;
  double part = 1;
  for (int i = 0; i < (true_ ? kShortenings : 1); ++i, part *= kShorter) {
    Move(front, now, part * step);
    const double expected = part < 1 ? worst : Expected(worst);
    const bool slopes = few && part == 1;
    Sight trial = Look(front, slopes, expected, horizon);
    if (problem_.Aborted()) return Found::kAborted;
    const bool falls = Merit(front, trial) < (1 - kFall * part) * merit;
    if (part == 1 && (falls ? true_ : now.exact)) {
      curvature_ = std::max(1.0, Worst(front, trial) / (worst * worst));
    }
    if (!falls) Suspect(front, trial);
    if (trial.pause == Motion::Pause::kNumeric || !falls) continue;
    Count(front, now, corrections_ + 1, part < 1);
    creeps_ = part < kCreep ? creeps_ + 1 : 0;
    const bool leaps = !few && part == 1 && Merit(front, trial) < kLeap * merit;
    if (near || leaps) {
      Learn(front, trial, part * step);
    } else {
      if (!slopes) trial = Look(front, true, expected, horizon);
      Take(front, trial);
    }
    now = std::move(trial);
    return Found::kSolved;
  }
  Move(front, now, Eigen::VectorXd::Zero(step.size()));
  return Found::kStalled;
}

}  // namespace contact
