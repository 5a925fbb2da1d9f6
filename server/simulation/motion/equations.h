#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// δⁿ and its derivative n δⁿ⁻¹; both 0 for δ ≤ 0.
struct Power {
  double value = 0;
  double slope = 0;

  Power(double deformation, double exponent) {
    if (deformation <= 0) return;
    const double root =
        exponent == 1.5 ? std::sqrt(deformation) : std::pow(deformation, exponent - 1);
    value = deformation * root;
    slope = exponent * root;
  }
};

/// The bodies that a contact joins. A wall is body 0 that counts nothing.
struct Sides {
  std::ptrdiff_t left = 0, right = 0;
  double left_counts = 0, right_counts = 0;    ///< 1; 0 for a wall.
  double left_inverse = 0, right_inverse = 0;  ///< 1/m [1/kg]; 0 for a wall or a fixed body.

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
  int contact = 0;     ///< Index in Scenario::contacts.
  int column = kNone;  ///< Sensitivity column of its μ, or kNone.
  double gap = 0;      ///< δ = u_left − u_right − gap [m].
  double stiffness = 0, exponent = 1.5, damping_exponent = 1.5, mu = 0;
  bool clipped = false;  ///< A force below 0 counts as 0.
  bool plain = false;    ///< n = p = 1.5: what most are.
  double outward = 0;  ///< Of F, what is no internal force: 1 or −1 against a wall or fixed body.
  /// Accelerations of the bodies by a force of 1 N, where there are no more than these.
  std::array<double, 3> response = {};

  /// F = k δⁿ + μ δᵖ δ̇ and its derivatives, (M2). δ⁰ is 1 also where round-off or a stage of the
  /// integrator takes δ past 0.
  struct Force {
    double force, by_deformation, by_rate, damping;  ///< damping = ∂F/∂μ = δᵖ δ̇.
  };
  Force At(double deformation, double rate) const {
    if (!plain || clipped) return General(deformation, rate);
    return Plain(deformation, rate);
  }
  Force Plain(double deformation, double rate) const {
    const double root = std::sqrt(std::max(deformation, 0.0));
    const double power = deformation * root;
    const double load = stiffness + mu * rate;
    return {power * load, 1.5 * root * load, mu * power, power * rate};
  }
  Force General(double deformation, double rate) const;
  /// At(…).force alone.
  double ForceAt(double deformation, double rate) const {
    if (!plain) return General(deformation, rate).force;
    const double load = stiffness + mu * rate;
    if (deformation <= 0 || (clipped && load < 0)) return 0;
    return deformation * std::sqrt(deformation) * load;
  }
  /// Whether (M2) would pull and is clipped; at δ ≤ 0 whether it does so just before.
  bool Clips(double deformation, double rate) const {
    if (!clipped) return false;
    const double power = std::pow(std::max(deformation, 0.0), exponent - damping_exponent);
    return stiffness * power + mu * rate < 0;
  }
};

/// The equations of motion as a first-order system, (M1) to (M5) of README.md, with the
/// quadratures that the ledger needs and the sensitivities that the μ-solve needs.
///
/// Displacements u are measured from `base`, near which they stay small, so that deformations
/// keep their digits however far a body has come. State vector y, N bodies and C contacts:
///   [u (N), v (N)]
///   [∂u/∂μ, ∂v/∂μ]                             for each column, when not recording
/// and then quadratures, on which no slope depends:
///   [W (C)]                                    work of the running cycles
///   [∂W/∂μ]                                    for each column, when not recording
///   [E (C), load work, support loss, impulse]  when recording
class Equations {
 public:
  explicit Equations(const Scenario& scenario);

  int bodies() const { return bodies_; }
  int contacts() const { return contacts_; }
  /// Where things are in y.
  std::ptrdiff_t size() const {
    return work(contacts()) + (recording ? contacts() + 3 : tangents() * contacts());
  }
  std::ptrdiff_t coupled() const { return 2 * std::ptrdiff_t{bodies()} * (1 + tangents()); }
  std::ptrdiff_t tangent(int column) const { return 2 * std::ptrdiff_t{bodies()} * (1 + column); }
  std::ptrdiff_t work(int contact) const { return coupled() + contact; }
  std::ptrdiff_t work_tangent(int contact, int column) const {
    return work(contact) + std::ptrdiff_t{contacts()} * (1 + column);
  }
  std::ptrdiff_t external_work(int contact) const { return work(contacts()) + contact; }
  std::ptrdiff_t load_work() const { return external_work(contacts()); }
  std::ptrdiff_t support_loss() const { return load_work() + 1; }
  std::ptrdiff_t impulse() const { return load_work() + 2; }

  /// dy = pace · f(t, y): slopes by a clock of which a second is 1/pace.
  void operator()(double t, const double* y, double* dy, double pace = 1) const {
    few_ == nullptr ? EvaluateMany(t, y, dy, pace) : few_(*this, y, dy, pace);
  }

  const Sides& sides(int contact) const { return sides_[static_cast<std::size_t>(contact)]; }
  /// Difference left − right of a per-body quantity; a wall counts 0.
  double Relative(int contact, const double* of_bodies) const {
    return sides(contact).Relative(of_bodies);
  }

  double effective_mass(int contact) const;  ///< m_e [kg].
  ActiveContact Activate(int contact, double gap, double mu, int column) const;
  double inverse_mass(int body) const { return inverse_mass_[static_cast<std::size_t>(body)]; }
  const Scenario& scenario() const { return scenario_; }

  double Energy(const double* y) const;    ///< Kinetic, springs, contacts: (B1) [J].
  double Momentum(const double* y) const;  ///< Of the bodies that are not fixed [N·s].

  /// Takes the loads that act from `time` on, until the instant returned, the next at which one
  /// begins or ends; infinite if none does. Each goes on as its formula does past that instant.
  double SelectLoads(double time);

  /// Call when `active` or the selected loads have changed: sees whether all there is are one or
  /// two plain contacts of at most three bodies, for which there is a shorter way.
  void Prepare();

  /// Shortest time in which a selected load or a support changes [s]; infinite without any.
  double ForcingTime() const;

  std::vector<double> base;           ///< Positions from which u is measured [m].
  std::vector<ActiveContact> active;  ///< In order of Scenario::contacts.
  int columns = 0;
  bool recording = false;

 private:
  std::ptrdiff_t tangents() const { return recording ? 0 : columns; }
  void AddSupports(const double* y, double* dy, double pace) const;
  template <class Count>
  void AddContacts(Count n, const double* y, double* dy, double* works, double pace) const;
  template <class Count>
  void AddSensitiveContacts(Count n, const double* y, double* dy, double* works, double pace) const;
  template <class Count>
  void Evaluate(Count n, double t, const double* y, double* dy, double pace) const;
  void EvaluateMany(double t, const double* y, double* dy, double pace) const;
  template <std::ptrdiff_t n, std::size_t kCount, bool kWalls>
  static void EvaluateFew(const Equations& of, const double* y, double* dy, double pace);
  void AddRecord(double t, const double* y, double* dy, double pace) const;
  double LoadForce(const Load& load, double t) const;
  double SupportForce(const Support& s, const double* u, const double* v) const;

  const Scenario& scenario_;
  int bodies_, contacts_;             // Counts.
  std::vector<double> inverse_mass_;  // 0 for a fixed body.
  std::vector<Sides> sides_;          // Of every contact.
  std::vector<Load> acting_;          // The loads selected.
  std::vector<double> breakpoints_;   // Where loads begin and end; sorted.
  void (*few_)(const Equations&, const double*, double*, double) = nullptr;  // The shorter way.
};

/// U = k δⁿ⁺¹/(n + 1) [J].
double ElasticEnergy(const Contact& contact, double deformation);

}  // namespace contact
