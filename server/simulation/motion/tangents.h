#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "simulation/model/scenario.h"
#include "simulation/motion/contact_events.h"
#include "simulation/motion/equations.h"
#include "simulation/motion/runge_kutta.h"

namespace contact {

/// The derivatives of the motion and of the works by the μ of groups of cycles, (S1) to (S3) of
/// README.md.
///
/// Along a motion that is known they obey linear equations and steer no step. So each step of the
/// motion is taken first, and they follow it with the classical Runge–Kutta method, in as many
/// parts as their own rates demand: slopes are for Newton's method and need far fewer digits than
/// the motion.
class Tangents {
 public:
  /// Both must outlive the tangents.
  Tangents(const Scenario& scenario, const Equations& equations);

  /// Forgets every μ.
  void Clear();
  /// Takes in one more μ; nothing depends on it yet.
  void Add();
  /// How many μ there are.
  Eigen::Index count() const { return u_.rows(); }
  /// Call when the equations' active contacts have changed.
  void Prepare();

  /// Follows a step of the motion from θ = `from` to `to`. `paths` are the deformations of the
  /// active contacts, in their order.
  void Follow(const StepTime& step, const std::vector<DeformationPath>& paths, double from,
              double to);
  /// The work of a contact is counted from this instant on.
  void Restart(int contact) { work_.col(contact).setZero(); }
  /// Changes the velocities where the force of a contact begins or ends with a jump, (S3), by
  /// `growth`, the force that begins, over δ̇ [N·s/m].
  void Jump(const Sides& sides, double growth);
  /// ∂W/∂μ of a contact, for each μ, (S2).
  Eigen::ArrayXd Work(int contact) const { return work_.col(contact); }

 private:
  /// A contact or support between bodies that are counted among those that a force moves.
  struct Link : Sides {
    /// The μ of a contact, or kNone.
    int column = kNone;
  };
  /// A force and its derivatives by δ, δ̇ and μ, by the clock of θ, and δ̇ itself [m/s].
  struct Law {
    double force = 0, by_deformation = 0, by_rate = 0, damping = 0, rate = 0;
  };

  /// Counts a body among those that are moved, and returns its place.
  std::ptrdiff_t PlaceOf(std::ptrdiff_t body);
  /// Adds a link between the bodies of `sides`.
  void Connect(const Sides& sides, int column);
  /// The laws of all links at θ; `pace` is dt/dθ [s].
  void Evaluate(const StepTime& step, const std::vector<DeformationPath>& paths, double theta,
                std::vector<Law>* laws) const;
  /// In how many parts a stretch of θ must be taken in which these are the laws.
  double Parts(const std::vector<Law>& laws, double pace, double length) const;
  /// dx/dθ by the laws; `count` is the number of μ.
  template <class Count>
  void Slopes(Count count, const std::vector<Law>& laws, double pace, const double* x,
              double* dx) const;
  /// One step of the classical method, of `length` in θ.
  template <class Count>
  void Step(Count count, const double (&pace)[3], double length);
  /// Copies what is moved from u, v and W to x, or back.
  void Gather();
  void Scatter();

  const Scenario& scenario_;
  const Equations& equations_;
  // ∂u/∂μ and ∂v/∂μ: a row for each μ, a column for each body; ∂W/∂μ: a column for each contact.
  Eigen::ArrayXXd u_, v_, work_;
  // The bodies that a force moves, and the place of each body among them, or kNone.
  std::vector<std::ptrdiff_t> moved_, place_;
  // The active contacts, then the supports.
  std::vector<Link> links_;
  // The laws of the links at the begin, middle and end of a part.
  std::vector<Law> laws_[3];
  // ∂u/∂μ and ∂v/∂μ of the moved bodies and ∂W/∂μ of the active contacts, a column each; its
  // slopes, their weighted sum, and a stage.
  Eigen::ArrayXXd x_, slope_, sum_, stage_;
};

}  // namespace contact
