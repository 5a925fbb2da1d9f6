#pragma once

#include <Eigen/Core>

#include "simulation/motion/state.h"

namespace contact {

/// Chooses the μ of cycles and hears of their ends. Called within Motion::Advance.
class CycleHost {
 public:
  virtual ~CycleHost() = default;
  /// What a cycle begins with.
  struct Factor {
    /// μ [N·s/mᵖ⁺¹], ≥ 0.
    double mu = 0;
    /// Sensitivity column of this μ, at most one past those in use; or kNone.
    int column = kNone;
    /// Expected δ_m − δ_s [m], for the error control; 0: unknown.
    double length = 0;
    /// Expected largest |δ̇| [m/s], for the error control; 0: unknown.
    double speed = 0;
  };
  /// A cycle begins: `state.cycle` holds contact, number, kind and start. `external_force` is F_e
  /// there [N].
  virtual Factor OnStart(ContactState& state, double effective_mass, double external_force) = 0;
  /// A cycle has ended; the gradients hold ∂W_c/∂μ and ∂W_r/∂μ of each column.
  /// May change status and bookkeeping of `state`. `length` and `speed` are what Factor expects.
  virtual void OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
                     const Eigen::ArrayXd& restitution_gradient, double length, double speed) = 0;
  /// The cycle that OnStart heard of last for this contact has ended without duration or work: it
  /// counts as none, and the next cycle of the contact has its number.
  virtual void OnCancel(ContactState& /*state*/) {}
  /// The cycle that OnStart heard of last for this contact gives back what was stored before its
  /// start, without a compression before. Returns its μ.
  virtual double OnRelease(ContactState& state, double /*effective_mass*/) {
    return state.cycle.mu;
  }
  /// When the rest of a contact is known to end [s]: asked where the rest begins, or Advance does.
  virtual double RestEnds(const ContactState& /*state*/) { return kNever; }
  /// A contact rests no more, and its rest should have ended at `cause` [s]. True: it ends now.
  virtual bool OnDisturbed(const ContactState& /*state*/, double /*cause*/) { return true; }
  /// A step begins; false: the host has seen enough.
  virtual bool OnStep() { return true; }
};

}  // namespace contact
