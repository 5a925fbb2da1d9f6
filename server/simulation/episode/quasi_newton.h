#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <utility>
#include <vector>

namespace contact {

/// The Jacobian of a system of equations r(μ) = 0: a true one from time to time, and Broyden's
/// update of it by what every step in between has shown. Source: Broyden, A class of methods for
/// solving nonlinear simultaneous equations, Math. Comp. 19 (1965), method 1.
class QuasiNewton {
 public:
  /// Contact and number of each unknown's cycle, in order.
  using Cycles = std::vector<std::pair<int, int>>;

  void Forget() { of_.clear(); }
  bool IsOf(const Cycles& cycles) const { return of_ == cycles; }

  /// Takes the true Jacobian ∂r/∂ln μ at μ > 0, where the residuals are r.
  void Set(Cycles of, const Eigen::VectorXd& mu, const Eigen::VectorXd& r,
           const Eigen::MatrixXd& by_logarithm);
  /// Takes it that μ has the residuals r. With `learn` the Jacobian is updated; without, kept: for
  /// packings, whose motion changes in jumps.
  void Update(const Eigen::VectorXd& mu, const Eigen::VectorXd& r, bool learn = true);
  /// The relative changes of μ that bring r to 0, to first order, from the last Set or Update.
  Eigen::VectorXd Step() const;

 private:
  Cycles of_;
  Eigen::VectorXd unit_;      // μ of the true Jacobian, by which all are measured.
  Eigen::VectorXd at_, r_;    // The last μ, in these units, and residuals.
  Eigen::MatrixXd jacobian_;  // ∂r/∂(μ/unit).
  bool true_ = false;         // jacobian_ is the tangent at the last μ, not a chord.
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace contact
