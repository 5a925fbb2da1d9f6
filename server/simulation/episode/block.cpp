#include "simulation/episode/block.h"

#include <algorithm>
#include <cmath>

#include "simulation/episode/search_options.h"

namespace contact {
namespace {

// A step changes a μ by this factor at most: further off the slopes tell nothing.
constexpr double kMostFactor = 5;
// Residual of a group that does not end with a trial μ: worse than any that does.
constexpr double kOpenResidual = 10;

Eigen::Index Index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

Eigen::VectorXd Block::Mu() const {
  Eigen::VectorXd mu(Index(ids_.size()));
  for (std::size_t i = 0; i < ids_.size(); ++i) mu[Index(i)] = problem_.groups.At(ids_[i]).mu;
  return mu;
}

void Block::Set(const Eigen::VectorXd& mu) {
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    Unknown& unknown = problem_.groups.At(ids_[i]);
    unknown.mu = mu[Index(i)];
    unknown.corrected = true;
  }
}

Sight Block::Look(bool slopes) {
  return problem_.March(ids_, {.slopes = slopes,
                               .wide = slopes && coarse_ && ids_.size() <= kSearch.at_once,
                               .until = until_,
                               .tolerance = coarse_ ? kSearch.ahead_tolerance : 0,
                               .miss = miss_,
                               .guess_from = end_});
}

Residuals::Value Block::Begin() { return Begin(Look(true)); }

Residuals::Value Block::Begin(Sight sight) {
  double start = kNever, end = 0;
  for (const GroupId& id : ids_) {
    const GroupSight* g = sight.Find(id);
    if (g == nullptr || !g->ended) continue;
    start = std::min(start, g->start_time), end = std::max(end, g->end_time);
  }
  if (end > start) end_ = end, until_ = end + kSearch.trial_spans * (end - start);
  last_ = taken_ = std::move(sight);
  Value value = Of(last_, true);
  value.valid &= end > start;
  return value;
}

Residuals::Value Block::Of(const Sight& sight, bool slopes) const {
  const Eigen::Index n = Index(ids_.size());
  Value value{.residuals = Eigen::VectorXd::Zero(n), .slopes = {}};
  if (slopes) value.slopes = Eigen::MatrixXd::Identity(n, n);
  value.valid = sight.pause != Motion::Pause::kNumeric;
  std::vector<const GroupSight*> seen;
  for (const GroupId& id : ids_) seen.push_back(sight.Find(id));
  for (Eigen::Index i = 0; i < n; ++i) {
    const GroupSight* g = seen[static_cast<std::size_t>(i)];
    if (g == nullptr) continue;  // It came to nothing.
    const bool known = g->ended && std::isfinite(g->residual);
    const double r = known ? g->residual : kOpenResidual;
    value.merit += r * r;
    if (!g->weak) value.miss = std::max(value.miss, known ? std::abs(g->Miss()) : kNever);
    if (!known || !(g->mu > 0)) continue;
    value.residuals[i] = r;
    if (!slopes || g->column == kNone) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      const GroupSight* by = seen[static_cast<std::size_t>(j)];
      const bool moves = by != nullptr && by->column != kNone && by->column < g->gradient.size();
      value.slopes(i, j) = moves ? g->gradient[by->column] * by->mu : 0;
    }
  }
  return value;
}

Residuals::Value Block::At(const Eigen::VectorXd& x, bool slopes) {
  Set(x);
  last_ = Look(slopes);
  return Of(last_, slopes);
}

Eigen::VectorXd Block::Moved(const Eigen::VectorXd& x, const Eigen::VectorXd& step) const {
  return x.array() * (1 + step.array()).max(1 / kMostFactor).min(kMostFactor);
}

void Block::OnStep(double part) {
  for (GroupSight& g : taken_.groups) {
    if (std::ranges::find(ids_, g.id) == ids_.end()) continue;
    g.update = part < 1 ? Iteration::Update::kDampedNewton : Iteration::Update::kNewton;
    ++problem_.groups.At(g.id).iterations;
  }
  log_.Correct(taken_);
  taken_ = last_;
}

}  // namespace contact
