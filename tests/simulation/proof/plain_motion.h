#pragma once

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "simulation/model/scenario.h"
#include "simulation/proof/extrapolated_midpoint.h"

namespace contact::testing {

/// The plain equations of motion of a scenario whose μ are known, integrated by extrapolation of
/// the midpoint rule, or by Rosenbrock's method where a contact creeps. A contact has its force
/// while it is engaged, by its μ. Displacements are those of one step: a deformation keeps its
/// digits however far its bodies travel.
class PlainMotion {
 public:
  /// What the errors of an engaged contact are relative to; > 0.
  struct Scale {
    double deformation, speed, work;
  };

  /// `speed`: of the fastest body, > 0; what the errors of all bodies are relative to. `tolerance`:
  /// of a step.
  PlainMotion(const Scenario& scenario, double speed, double tolerance);

  void Engage(int contact, double mu, const Scale& scale);
  void Disengage(int contact);

  double time() const { return time_; }
  int steps() const { return steps_; }
  double fastest() const { return fastest_; }  ///< Largest speed of a body so far [m/s].
  double Deformation(int contact) const { return -gaps_[At(contact)]; }
  double Rate(int contact) const;
  double Velocity(int body) const { return state_[bodies_ + At(body)]; }
  /// ∫F dδ since the contact was engaged [J].
  double Work(int contact) const { return state_[2 * bodies_ + At(contact)]; }
  /// Largest deformation of a contact while it was not engaged, at the ends of steps [m].
  double Overlap(int contact) const { return overlaps_[At(contact)]; }

  /// Moves on to `end`. Returns false, and stands where it was then, after `most_steps` in all, or
  /// where a step would vanish.
  bool Advance(double end, int most_steps);

 private:
  using Vector = std::vector<double>;

  static constexpr double kNone_ = std::numeric_limits<double>::quiet_NaN();
  static std::size_t At(int index) { return static_cast<std::size_t>(index); }

  // The force between two bodies, or one and the ground, and its slopes.
  struct Force {
    double value, by_deformation, by_rate;
  };
  Force ContactForce(std::size_t contact, const Vector& y) const;
  double LoadForce(const Load& load, double t) const;
  double LoadSlope(const Load& load, double t) const;
  template <class Piece>
  bool Acts(const Piece& piece) const {
    return time_ >= piece.begin && time_ < piece.end;
  }
  double Difference(int left, int right, const Vector& y, std::size_t from) const;
  double InverseMass(int body) const;
  void Slopes(const Vector& y, Vector& dy, double t) const;
  void Jacobian(Eigen::MatrixXd& j, Eigen::VectorXd& by_time) const;
  void Couple(int left, int right, const Force& force, Eigen::MatrixXd& j) const;
  void Creep(double step, Vector& reached, Vector& error) const;

  double NextEdge(double end) const;
  double Stiffest() const;
  double Error(const Vector& error, double step) const;
  void Accept(const Vector& reached, double time);

  const Scenario& s_;
  std::size_t bodies_;
  double speed_, tolerance_;
  std::vector<double> exponents_;  // p of each contact.
  std::vector<double> mu_;         // NaN: not engaged.
  std::vector<Scale> scales_;
  std::vector<double> gaps_, stretches_, overlaps_;  // Of contacts; of supports; of contacts.
  std::vector<double> yields_;                       // δ_y of tables.
  Vector state_;  // Displacements in the step, velocities, works.
  double time_ = 0, step_ = 1e-7;
  int steps_ = 0, stiff_ = 0;
  double fastest_ = 0;
  ExtrapolatedMidpoint taken_;
};

}  // namespace contact::testing
