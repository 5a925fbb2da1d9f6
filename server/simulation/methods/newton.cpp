#include "simulation/methods/newton.h"

#include <Eigen/LU>
#include <utility>

namespace contact {
namespace {

// A step that does not help is shortened by this factor.
constexpr double kShorter = 0.35;
// Part of the fall of the merit expected by the slope that a step must bring.
constexpr double kFall = 0.3;

}  // namespace

Eigen::VectorXd Newton::Step(const Residuals::Value& value) {
  const Eigen::VectorXd step = -value.slopes.partialPivLu().solve(value.residuals);
  return step.allFinite() ? step : Eigen::VectorXd(-value.residuals);
}

// Whether tangents lead below −1 of an unknown twice in a row: in a coordinate such as ln μ to
// where there is nothing.
bool Newton::Sinks(const Eigen::VectorXd& step) {
  const auto before = std::exchange(sinks_, step.array() <= -1);
  return before.size() == sinks_.size() && (before && sinks_).any();
}

// One step, shortened until the merit falls enough; false: none helps.
bool Newton::Correct(Eigen::VectorXd* x) {
  const Eigen::VectorXd step = Step(now_);
  if (options_.limited && Sinks(step)) return false;
  double part = 1;
  for (int i = 0; i < options_.most_trials; ++i, part *= kShorter) {
    const Eigen::VectorXd there = equations_.Moved(*x, part * step);
    const bool slopes = i == 0 && options_.slopes_at_once;
    Residuals::Value value = equations_.At(there, slopes);
    if (equations_.Aborted()) return false;
    if (!value.valid || !(value.merit < (1 - kFall * part) * now_.merit)) continue;
    ++steps_;
    equations_.OnStep(part);
    *x = there;
    const bool enough = slopes || value.miss <= options_.goal;
    now_ = enough ? std::move(value) : equations_.At(there, true);
    return true;
  }
  return false;
}

Newton::End Newton::Solve(const NewtonOptions& options, Residuals::Value at, Eigen::VectorXd* x) {
  options_ = options;
  now_ = std::move(at);
  steps_ = 0;
  sinks_.resize(0);
  while (true) {
    if (equations_.Aborted()) return End::kAborted;
    if (!now_.valid) return End::kStalled;
    if (now_.miss <= options.goal) return End::kSolved;
    if (steps_ >= options.most_steps) return End::kLimit;
    if (now_.miss * now_.miss <= options.blind) {
      equations_.OnStep(1);
      ++steps_;
      *x = equations_.Moved(*x, Step(now_));
      return End::kUnseen;
    }
    if (!Correct(x)) return equations_.Aborted() ? End::kAborted : End::kStalled;
  }
}

}  // namespace contact
