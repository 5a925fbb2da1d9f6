#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "simulation/laws/force_table.h"
#include "simulation/laws/power.h"
#include "simulation/laws/spring.h"
#include "simulation/model/piece_rows.h"
#include "simulation/model/scenario.h"
#include "simulation/motion/state.h"
#include "simulation/motion/state_layout.h"

namespace contact {

/// The bodies that a contact joins. A wall is body 0 that counts nothing.
struct Sides {
  /// Indices in Scenario::bodies; 0 for a wall.
  std::ptrdiff_t left = 0, right = 0;
  /// 1 for a body, 0 for a wall.
  double left_counts = 0, right_counts = 0;
  /// 1/m [1/kg]; 0 for a wall or a fixed body.
  double left_inverse = 0, right_inverse = 0;

  /// Difference left − right of a per-body quantity.
  double Relative(const double* of_bodies) const {
    return left_counts * of_bodies[left] - right_counts * of_bodies[right];
  }
  /// True if compression here moves a body against the other one of another contact.
  bool Pushes(const Sides& other) const {
    return (right_inverse > 0 && other.left_counts > 0 && other.left == right) ||
           (left_inverse > 0 && other.right_counts > 0 && other.right == left);
  }
};

/// A contact with a running cycle, as the equations of motion see it.
struct ActiveContact : Sides {
  /// Index in Scenario::contacts.
  int contact = 0;
  /// Sensitivity column of its μ, or kNone.
  int column = kNone;
  /// δ = u_left − u_right − gap [m].
  double gap = 0;
  /// k [N/mⁿ], n [-], p [-] and μ [N·s/mᵖ⁺¹] of (M2).
  double stiffness = 0, exponent = 1.5, damping_exponent = 1.5, mu = 0;
  /// Whether a force below 0 counts as 0.
  bool clipped = false;
  /// Whether n = p = 1.5, as in most contacts.
  bool plain = false;
  /// In place of k δⁿ; null: none. Its δ_y [m].
  const ForceTable* table = nullptr;
  double yield = 0;
  /// The part of F that is no internal force of the bodies: 1 against a wall or fixed body on the
  /// left, −1 on the right, else 0.
  double outward = 0;
  /// Accelerations of the bodies by a force of 1 N [1/kg]; zeros where there are more bodies.
  std::array<double, 3> response = {};

  /// F = k δⁿ + μ δᵖ δ̇ and its derivatives, (M2). δ⁰ is 1 also where round-off or a stage of the
  /// integrator takes δ past 0.
  struct Force {
    /// F [N], ∂F/∂δ [N/m], ∂F/∂δ̇ [N·s/m] and ∂F/∂μ = δᵖ δ̇.
    double force, by_deformation, by_rate, damping;
  };
  /// The force at δ [m] and δ̇ [m/s].
  Force At(double deformation, double rate) const {
    if (!plain || clipped) return General(deformation, rate);
    return Plain(deformation, rate);
  }
  /// At(…) of a plain contact that is not clipped.
  Force Plain(double deformation, double rate) const {
    const double root = std::sqrt(std::max(deformation, 0.0));
    const double power = deformation * root;
    const double load = stiffness + mu * rate;
    return {power * load, 1.5 * root * load, mu * power, power * rate};
  }
  /// At(…) of any contact.
  Force General(double deformation, double rate) const;
  /// ∂F/∂δ̇ = μ δᵖ of a force that is not clipped.
  double DampingAt(double deformation) const {
    const double d = std::max(deformation, 0.0);
    return mu * (plain ? d * std::sqrt(d) : std::pow(d, damping_exponent));
  }
  /// k n δⁿ⁻¹ or the slope of the table, the stiffness about δ without its damping [N/m].
  double StiffnessAt(double deformation) const {
    if (table != nullptr) return table->At(deformation, yield).slope;
    const double d = std::max(deformation, 0.0);
    return stiffness * (plain ? 1.5 * std::sqrt(d) : exponent * std::pow(d, exponent - 1));
  }
  /// At(…).force alone.
  double ForceAt(double deformation, double rate) const {
    if (!plain) return General(deformation, rate).force;
    const double load = stiffness + mu * rate;
    if (deformation <= 0 || (clipped && load < 0)) return 0;
    return deformation * std::sqrt(deformation) * load;
  }
  /// Whether the table has another slope at one δ than at the other.
  bool Bends(double from, double to) const {
    return table != nullptr && table->At(from, yield).slope != table->At(to, yield).slope;
  }
  /// Whether (M2) would pull and is clipped; at δ ≤ 0 whether it does so just before.
  bool Clips(double deformation, double rate) const {
    if (!clipped) return false;
    const double power = std::pow(std::max(deformation, 0.0), exponent - damping_exponent);
    return stiffness * power + mu * rate < 0;
  }
};

/// The equations of motion as a first-order system, (M1) to (M5) of README.md, with the
/// quadratures that the ledger needs.
///
/// Displacements u are measured from `base`, near which they stay small, so that deformations
/// keep their digits however far a body has come.
class Equations : public StateLayout {
 public:
  /// The scenario must outlive the equations.
  explicit Equations(const Scenario& scenario);

  /// dy = pace · f(t, y): slopes by a clock of which a second is 1/pace.
  void operator()(double t, const double* y, double* dy, double pace = 1) const {
    few_ == nullptr ? EvaluateMany(t, y, dy, pace) : few_(*this, y, dy, pace);
  }

  const Sides& sides(int contact) const { return sides_[static_cast<std::size_t>(contact)]; }
  /// Difference left − right of a per-body quantity; a wall counts 0.
  double Relative(int contact, const double* of_bodies) const {
    return sides(contact).Relative(of_bodies);
  }

  /// By how much the support with this index is longer than without force [m].
  double Stretch(std::size_t support, const double* u) const {
    return StretchAtBase(support) + Relative(scenario_.supports[support], u);
  }
  /// The same at displacements of 0 [m].
  double StretchAtBase(std::size_t support) const {
    return stretches_[support] - slips[support].slack;
  }
  /// The spring of the support with this index, at that length.
  Spring SpringOf(std::size_t support, double stretch) const {
    const Support& s = scenario_.supports[support];
    const int side = slips[support].side;
    if (side != 0) return Spring::Slipping(s.stiffness, side * s.slip_force);
    return {s.stiffness, s.higher, stretch};
  }
  /// Two bodies, or a body and, as kNone, a wall.
  Sides SidesOf(int left, int right) const;

  /// m_e of a contact [kg], (M5); a wall or fixed body counts as infinitely heavy.
  double effective_mass(int contact) const;
  /// The contact for `active`, with δ = u_left − u_right − `gap`. `yield`: δ_y of a table [m].
  ActiveContact Activate(int contact, double gap, double mu, int column, double yield = 0) const;

  /// Force of the support with this index on its first body [N], (M4).
  [[gnu::always_inline]] double SupportForce(std::size_t support, const double* u,
                                             const double* v) const {
    const Support& s = scenario_.supports[support];
    const double stretch = Stretch(support, u);
    const double spring = s.IsLinear() ? s.stiffness * stretch : SpringOf(support, stretch).force;
    return -spring - s.damping * Relative(s, v);  // (M4)
  }
  /// Energy in the spring of the support with this index [J].
  double SupportEnergy(std::size_t support, const double* u) const;

  /// Kinetic energy of the bodies that are not fixed [J].
  double KineticEnergy(const double* y) const;
  /// Elastic energy of the active contacts [J], (W2).
  double ContactEnergy(const double* y) const;
  /// Kinetic energy, and elastic energy of the supports and of the active contacts [J], (B1).
  double Energy(const double* y) const;
  /// Momentum of the bodies that are not fixed [N·s], (B2).
  double Momentum(const double* y) const;

  /// Σ|m v| of the bodies that are not fixed [N·s].
  double MomentumScale(const double* y) const;

  /// Takes the loads and drives that act from `time` on, at which the displacements are `u` (null:
  /// 0), until the instant returned, the next at which one begins or ends; infinite if none does.
  /// Each goes on as its formula does past that instant.
  double SelectLoads(double time, const double* u = nullptr);
  /// Puts the driven bodies in y where they are at t, and gives them their velocities.
  void PlaceDriven(double t, double* y) const;

  /// Call when `active` or the selected loads have changed: sees whether all there is are one or
  /// two plain contacts of at most three bodies that nothing else moves, for which there is a
  /// shorter way.
  void Prepare();

  /// All loads, and all drives, by their times.
  const PieceRows<Load>& loads() const { return loads_; }
  const PieceRows<Drive>& drives() const { return drives_; }
  /// The loads that act, and the drives.
  const std::vector<Load>& acting() const { return acting_; }
  const std::vector<Drive>& driving() const { return driving_; }
  /// Adds to accelerations by how much those of the selected loads and drives differ between two
  /// instants.
  void AddLoadChange(double from, double to, double* accelerations) const;

  /// Shortest time in which a selected load or drive, or a support changes [s]; infinite without
  /// any.
  double ForcingTime() const;

  /// Measures u from these positions [m], one for each body, from now on.
  void Rebase(const std::vector<double>& positions);
  /// Positions from which u is measured [m], one for each body.
  const std::vector<double>& base() const { return base_; }
  /// Σ k/m of the supports at the two sides of a contact [1/s²].
  double SupportRate(const Sides& sides) const {
    return sides.left_counts * support_rates_[static_cast<std::size_t>(sides.left)] +
           sides.right_counts * support_rates_[static_cast<std::size_t>(sides.right)];
  }

  /// The contacts that exert a force, in order of Scenario::contacts.
  std::vector<ActiveContact> active;
  /// In order of Scenario::supports.
  std::vector<Slip> slips;

 private:
  /// Adds the supports to the accelerations.
  void AddSupports(const double* y, double* dy, double pace) const;
  /// Adds the active contacts to the accelerations.
  template <class Count>
  void AddContacts(Count n, const double* y, double* dy, double* works, double pace) const;
  /// All slopes, for `n` bodies: a number or an integral constant.
  template <class Count>
  void Evaluate(Count n, double t, const double* y, double* dy, double pace) const;
  /// Calls Evaluate with what is known of the number of bodies.
  void EvaluateMany(double t, const double* y, double* dy, double pace) const;
  /// The slopes with n bodies, kCount active contacts and no loads or supports. kWalls: a side of
  /// some contact may be a wall.
  template <std::ptrdiff_t n, std::size_t kCount, bool kWalls>
  static void EvaluateFew(const Equations& of, const double* y, double* dy, double pace);
  /// Adds the work that drives do on what moves.
  void AddDriveWork(const double* y, double* dy, double pace) const;
  /// Adds the quadratures that only a recording has.
  void AddRecord(double t, const double* y, double* dy, double pace) const;
  /// Difference of a per-body quantity between the bodies of a support; the ground counts 0.
  static double Relative(const Support& s, const double* of_bodies) {
    return of_bodies[s.body] - (s.other == kNone ? 0 : of_bodies[s.other]);
  }

  const Scenario& scenario_;
  const PieceRows<Load> loads_;
  const PieceRows<Drive> drives_;
  std::vector<double> base_;
  // Stretch of each support at the base [m]: with u beside it forces keep their digits.
  std::vector<double> stretches_;
  // Σ k/m of the supports of each body [1/s²].
  std::vector<double> support_rates_;
  // 1/m [1/kg]; 0 for a fixed body.
  std::vector<double> inverse_mass_;
  // One for every contact.
  std::vector<Sides> sides_;
  // The loads and drives that SelectLoads found.
  std::vector<Load> acting_;
  std::vector<Drive> driving_;
  // When it found them [s], and the displacements of the driven bodies then [m].
  double selected_ = 0;
  std::vector<double> driven_from_;
  // Displacements and velocities, with those of driven bodies as they are at an instant.
  mutable std::vector<double> placed_;
  // Instants at which loads or drives begin or end [s], ascending.
  std::vector<double> breakpoints_;
  // EvaluateFew for what there is; null if Evaluate must do it.
  void (*few_)(const Equations&, const double*, double*, double) = nullptr;
};

}  // namespace contact
