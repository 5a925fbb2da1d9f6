#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/episode/iteration_log.h"
#include "simulation/episode/problem.h"

namespace contact {

/// How a search on a front came out.
enum class Found {
  kSolved,   ///< Every group of the front has its restitution.
  kStalled,  ///< It finds nothing better.
  kLimit,    ///< It has made as many corrections as it may.
  kAborted,  ///< See Problem::Aborted.
};

/// Newton's method on A(ε_out) = A(ε_in) of all groups of a front together, with true slopes. The
/// sum of the squares of the residuals of the groups that the front has must fall with each step;
/// groups that come into being by it are a matter for their own turn.
class Newton {
 public:
  Newton(Problem& problem, IterationLog& log) : problem_(problem), log_(log) {}

  /// Solves the front until no group of it misses its restitution by more than `goal`, relative.
  /// `coarse`: passes may be as inexact as what they are to show allows; the last correction is
  /// taken without a look where it is sure to do. `seen`: the scan that has seen the front; if it
  /// has slopes the search begins with it.
  Found Solve(const std::vector<GroupId>& front, double goal, int most_corrections, bool coarse,
              const Sight& seen);
  /// Corrections made by the last Solve.
  int corrections() const { return corrections_; }
  /// The group because of which the last Solve has stalled, for all that Newton's method can tell:
  /// tangents lead to μ < 0 of it, or it missed most where no step helped; or none.
  const std::vector<GroupId>& suspect() const { return suspect_; }

 private:
  using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;
  bool Sinks(const std::vector<GroupId>& front, const Eigen::VectorXd& step);
  void Suspect(const std::vector<GroupId>& front, const Sight& trial);
  Found Correct(const std::vector<GroupId>& front, Sight& now);
  void Take(const std::vector<GroupId>& front, const Sight& sight);
  void Learn(const std::vector<GroupId>& front, const Sight& sight, const Eigen::VectorXd& step);
  Eigen::VectorXd Step() const;
  static Eigen::VectorXd Residuals(const std::vector<GroupId>& front, const Sight& sight);
  double Merit(const std::vector<GroupId>& front, const Sight& sight) const;
  void Move(const std::vector<GroupId>& front, const Sight& from, const Eigen::VectorXd& step);
  void Count(const std::vector<GroupId>& front, Sight& sight, int corrections, bool damped);
  double Expected(double worst) const;
  double Worst(const std::vector<GroupId>& front, const Sight& sight) const;
  bool Overlooks(const std::vector<GroupId>& front, const Sight& sight) const;
  Sight Look(const std::vector<GroupId>& front, bool sensitive, double expected, double horizon);
  double Horizon(const std::vector<GroupId>& front, const Sight& sight) const;

  Problem& problem_;
  IterationLog& log_;
  double goal_ = 0;
  bool coarse_ = true;
  int corrections_ = 0;
  std::vector<GroupId> suspect_;  // One or none.
  int creeps_ = 0;                // Corrections in a row of a small part of a step.
  bool true_ = false;             // The Jacobian is that of a pass with sensitivities.
  Mask sinks_;                    // Groups of which the last step led to μ < 0.
  double curvature_ = 0;  // Largest miss after a whole true step over the square of that before.
  Eigen::MatrixXd jacobian_;  // ∂residual/∂ln μ.
  Eigen::VectorXd residual_;  // Of the last pass.
};

}  // namespace contact
