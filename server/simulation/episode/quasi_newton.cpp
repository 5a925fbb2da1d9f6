#include "simulation/episode/quasi_newton.h"

namespace contact {

void QuasiNewton::Set(Cycles of, const Eigen::VectorXd& mu, const Eigen::VectorXd& r,
                      const Eigen::MatrixXd& by_logarithm) {
  of_ = std::move(of);
  unit_ = (mu.array() > 0).select(mu, 1);
  at_ = mu.cwiseQuotient(unit_);
  r_ = r;
  jacobian_ = by_logarithm;
  true_ = true;
  factors_.compute(jacobian_);
}

void QuasiNewton::Update(const Eigen::VectorXd& mu, const Eigen::VectorXd& r, bool learn) {
  const Eigen::VectorXd at = mu.cwiseQuotient(unit_);
  const Eigen::VectorXd step = at - at_;
  if (const double square = step.squaredNorm(); learn && square > 0) {
    // From a tangent on, r is a parabola along the step, of which the tangent's miss is half of
    // what the slope has changed.
    const Eigen::VectorXd miss = r - r_ - jacobian_ * step;
    jacobian_ += (true_ ? 2 : 1) / square * miss * step.transpose();
    factors_.compute(jacobian_);
    true_ = false;
  }
  at_ = at;
  r_ = r;
}

Eigen::VectorXd QuasiNewton::Step() const {
  return -factors_.solve(r_).cwiseQuotient((at_.array() > 0).select(at_, 1).matrix());
}

}  // namespace contact
