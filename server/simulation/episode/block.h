#pragma once

#include <vector>

#include "simulation/episode/iteration_log.h"
#include "simulation/episode/problem.h"
#include "simulation/methods/newton.h"

namespace contact {

/// The equations of a block of groups, A(ε_out)/A(ε_in) − 1 = 0 of each: x are their μ, a step is
/// in relative changes of these.
class Block final : public Residuals {
 public:
  /// `miss`: a pass that solves the block goes on to the next group that misses by more than this.
  Block(Problem& problem, IterationLog& log, std::vector<GroupId> ids, bool coarse, double miss)
      : problem_(problem), log_(log), ids_(std::move(ids)), coarse_(coarse), miss_(miss) {}

  /// The equations as a pass has shown them. They are at the μ that it has seen.
  Value Begin(Sight sight);
  /// A pass of its own for that, with slopes.
  Value Begin();

  Value At(const Eigen::VectorXd& x, bool slopes) override;
  Eigen::VectorXd Moved(const Eigen::VectorXd& x, const Eigen::VectorXd& step) const override;
  void OnStep(double part) override;
  bool Aborted() const override { return problem_.Aborted(); }

  const std::vector<GroupId>& ids() const { return ids_; }
  Eigen::VectorXd Mu() const;
  void Set(const Eigen::VectorXd& mu);
  /// The last pass.
  Sight& last() { return last_; }

 private:
  Value Of(const Sight& sight, bool slopes) const;
  Sight Look(bool slopes);

  Problem& problem_;
  IterationLog& log_;
  std::vector<GroupId> ids_;
  bool coarse_;
  double miss_;
  double until_ = 1e300;  // What has not ended then is open [s].
  double end_ = kNever;   // Of the block as last seen [s]; what begins later is guessed anew.
  Sight taken_, last_;    // The pass that a step starts from, and the last one.
};

}  // namespace contact
