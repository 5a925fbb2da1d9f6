#include "simulation/methods/hybrid.h"

#include <Eigen/LU>
#include <utility>

namespace contact {
namespace {

// A step that does not help is shortened by this factor.
constexpr double kShorter = 0.35;
// Part of the fall of the merit expected by the slope that a step must bring.
constexpr double kFall = 0.3;

}  // namespace

Eigen::VectorXd Hybrid::NewtonStep(const Residuals::Value& value) {
  const Eigen::VectorXd step = -value.slopes.partialPivLu().solve(value.residuals);
  return step.allFinite() ? step : Eigen::VectorXd(-value.residuals);
}

// Whether tangents lead below −1 of an unknown twice in a row: in a coordinate such as ln μ to
// where there is nothing.
bool Hybrid::Sinks(const Eigen::VectorXd& step) {
  const auto before = std::exchange(sinks_, step.array() <= -1);
  return before.size() == sinks_.size() && (before && sinks_).any();
}

// Broyden's update by what a step has shown; from a tangent on the residuals are a parabola along
// the step, of which the tangent's miss is half of what the slope has changed by. Source: Broyden,
// A class of methods for solving nonlinear simultaneous equations, Math. Comp. 19 (1965), method 1.
void Hybrid::Learn(Residuals::Value value, const Eigen::VectorXd& step) {
  const Eigen::VectorXd miss = value.residuals - now_.residuals - now_.slopes * step;
  value.slopes = std::move(now_.slopes);
  if (const double square = step.squaredNorm(); square > 0) {
    value.slopes += (true_ ? 2 : 1) / square * miss * step.transpose();
  }
  now_ = std::move(value);
  true_ = false;
}

// One step, shortened until the merit falls enough; false: none helps.
bool Hybrid::Correct(Eigen::VectorXd* x) {
  const Eigen::VectorXd step = NewtonStep(now_);
  if (options_.limited && Sinks(step)) return false;
  const bool near = now_.miss < options_.near;
  double part = 1;
  for (int i = 0; i < (true_ ? options_.most_trials : 1); ++i, part *= kShorter) {
    const Eigen::VectorXd there = equations_.Moved(*x, part * step);
    const bool slopes = i == 0 && !near && options_.slopes_at_once;
    Residuals::Value value = equations_.At(there, slopes);
    if (equations_.Aborted()) return false;
    if (!value.valid || !(value.merit < (1 - kFall * part) * now_.merit)) continue;
    ++steps_;
    creeps_ = part < options_.creep ? creeps_ + 1 : 0;
    equations_.OnStep(part);
    *x = there;
    if (near) {
      Learn(std::move(value), part * step);
    } else if (slopes || value.miss <= options_.goal) {
      now_ = std::move(value);
    } else {
      now_ = equations_.At(there, true);
    }
    if (!near) true_ = true;
    return true;
  }
  return false;
}

Hybrid::End Hybrid::Solve(const HybridOptions& options, Residuals::Value at, Eigen::VectorXd* x) {
  options_ = options;
  now_ = std::move(at);
  true_ = true;
  steps_ = creeps_ = 0;
  sinks_.resize(0);
  while (true) {
    if (equations_.Aborted()) return End::kAborted;
    if (!now_.valid) return End::kStalled;
    if (now_.miss <= options.goal) return End::kSolved;
    if (steps_ >= options.most_steps) return End::kLimit;
    if (creeps_ > 1) return End::kStalled;
    if (true_ && now_.miss * now_.miss <= options.blind) {
      equations_.OnStep(1);
      ++steps_;
      *x = equations_.Moved(*x, NewtonStep(now_));
      return End::kUnseen;
    }
    if (Correct(x)) continue;
    if (true_) return equations_.Aborted() ? End::kAborted : End::kStalled;
    now_ = equations_.At(*x, true);
    true_ = true;
  }
}

}  // namespace contact
