#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "simulation/methods/banded_system.h"
#include "simulation/methods/runge_kutta.h"
#include "simulation/model/scenario.h"
#include "simulation/motion/contact_events.h"
#include "simulation/motion/equations.h"
#include "simulation/motion/linked_bodies.h"

namespace contact {

/// The derivatives of the motion and of the works by the μ of groups of cycles, (S1) to (S3) of
/// README.md.
///
/// Along a motion that is known they obey linear equations and steer no step. So each step of the
/// motion is taken first, and they follow it with the Gauss method of order 4, in as many parts as
/// their own rates demand: slopes are for Newton's method and need far fewer digits than the
/// motion. Where damping within the step is strong, Radau IIA of order 3 takes its place. Both are
/// implicit, so that parts need not be short there, and of linear equations their stages are one
/// linear system, the same for every μ. Source: Hairer, Wanner, Solving Ordinary Differential
/// Equations II, 2nd ed., Springer 1996, IV.5.
class Tangents {
 public:
  /// An implicit method with two stages: its nodes, its table and its weights.
  struct Method {
    double node[2], table[2][2], weight[2];
  };

  /// Both must outlive the tangents.
  Tangents(const Scenario& scenario, const Equations& equations);

  /// Forgets every μ.
  void Clear();
  /// Takes in one more μ; nothing depends on it yet.
  void Add();
  /// How many μ there are.
  Eigen::Index count() const { return u_.rows(); }
  /// Call when the equations' active contacts have changed, and after the first μ.
  void Prepare() { linked_.Count(); }

  /// Follows a step of the motion from θ = `from` to `to`. `paths` are the deformations of the
  /// active contacts, then the stretches of the supports that have k₂, k₃, …, in their order.
  void Follow(const StepTime& step, const std::vector<DeformationPath>& paths, double from,
              double to);
  /// The work of a contact is counted from this instant on.
  void Restart(int contact) { work_.col(contact).setZero(); }
  /// Changes the velocities where the force of a contact begins or ends with a jump, (S3), by
  /// `growth`, the force that begins, over δ̇ [N·s/m].
  void Jump(const Sides& sides, double growth);
  /// The way back of a contact begins here: its δ_y is its δ.
  void Yield(int contact, const Sides& sides);
  /// A spring that has slipped sticks: its slack position has gone along so far.
  void Stick(std::size_t support, const Sides& sides);
  /// ∂W/∂μ of a contact, for each μ, (S2).
  Eigen::ArrayXd Work(int contact) const { return work_.col(contact); }

 private:
  using Link = LinkedBodies::Link;
  /// A force and its derivatives by δ, δ̇ and μ, by the clock of a part, δ̇ itself [m/s], and the
  /// derivative by what the link remembers: a slack position or δ_y.
  struct Law {
    double force = 0, by_deformation = 0, by_rate = 0, damping = 0, rate = 0, by_memory = 0;
  };
  /// The two stages of a part: its length in time by the pace of each [s], and the laws of all
  /// links.
  struct Stages {
    double pace[2] = {};
    std::vector<Law> laws[2];
  };

  /// The stages of a part from θ = `from` to `to`.
  void Evaluate(const StepTime& step, const std::vector<DeformationPath>& paths, double from,
                double to);
  /// In how many parts that of the stages must be taken; chooses the method.
  double Plan();
  /// Sets up and decomposes the linear system of the stages' accelerations.
  void Assemble();
  /// The forces of the stages if nothing were accelerated, as the right sides of that system.
  template <class Count>
  void AddForces(Count count);
  /// Adds what slack positions of supports and δ_y of contacts do to them, and to works.
  void AddMemories();
  /// The difference of the bodies' displacements is what this column remembers.
  void Remember(Eigen::Index column, const Sides& sides);
  /// ∂u/∂μ and ∂v/∂μ of the linked bodies at the stages, by the accelerations.
  template <class Count>
  void Move(Count count);
  /// ∂W/∂μ at the end of a part.
  template <class Count>
  void AddWorks(Count count);
  /// Copies what is moved from u, v and W to x, or back.
  void Gather();
  void Scatter();

  const Scenario& scenario_;
  const Equations& equations_;
  // ∂u/∂μ and ∂v/∂μ: a row for each μ, a column for each body; ∂W/∂μ: a column for each contact; of
  // δ_y of contacts, and then slack positions of supports: a column for each.
  Eigen::ArrayXXd u_, v_, work_, memory_;
  // Whether one of memory_ is not 0.
  bool remembers_ = false;
  LinkedBodies linked_;
  const Method* method_ = nullptr;
  Stages stages_;
  // Of the accelerations at both stages, those of a body beside each other.
  BandedSystem system_;
  // ∂u/∂μ and ∂v/∂μ of the linked bodies and ∂W/∂μ of the active contacts, a column each.
  Eigen::ArrayXXd x_;
  // Accelerations at both stages of each linked body, by the clock of the part; right sides before.
  Eigen::ArrayXXd sides_;
  // u and v of the linked bodies at each stage.
  Eigen::ArrayXXd at_[2];
};

}  // namespace contact
