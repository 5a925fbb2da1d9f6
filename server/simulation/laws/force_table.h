#pragma once

#include <memory>
#include <vector>

#include "simulation/laws/power.h"

namespace contact {

/// A contact force F(δ) as a table, with a way back of its own: README.md of simulation/, (F1) to
/// (F3). L(δ) is linear from (0, 0) through the points, and goes on with its last slope:
///   F = L(δ)                              for δ ≥ δ_y,                                     (F1)
///   F = max(0, L(δ_y) − k_u (δ_y − δ))    below,  k_u = k₀ + S L(δ_y),
/// with δ_y the largest δ at which the contact has turned since it touched; 0 before. Without k₀
/// the force is L(δ) always.
class ForceTable {
 public:
  /// A point of L: δ [m] and F [N].
  struct Point {
    double deformation, force;
  };
  /// The way back: k₀ [N/m], 0 without one, else at least the steepest slope of L; S [1/m], ≥ 0.
  struct Unloading {
    double stiffness = 0, stiffening = 0;
  };

  /// No table.
  ForceTable() = default;
  /// Both numbers of the points are > 0, and grow from one to the next. At least one point.
  ForceTable(const std::vector<Point>& points, Unloading unloading);

  bool empty() const { return knots_ == nullptr; }
  /// Whether the way back is another than the way there.
  bool yields() const { return unloading_.stiffness > 0; }

  /// F [N] and ∂F/∂δ [N/m], (F1); 0 for δ ≤ 0.
  Power At(double deformation, double yield) const;
  /// ∂F/∂δ_y [N/m].
  double ByYield(double deformation, double yield) const;
  /// The energy that comes back if δ falls from here to 0 [J]:                              (F2)
  ///   U = ∫₀^δ L dδ, or F²/(2 k_u) with a way back.
  double Energy(double deformation, double yield) const;

  /// The δ [m] at which L is this force [N], ≥ 0.
  double DepthUnder(double force) const;
  /// The largest δ [m] of what arrives with this energy [J] and is pressed by this force P [N],
  /// both ≥ 0:                                                                            (F3)
  ///   ∫₀^δ L dδ = E + P δ.
  double DepthOf(double energy, double force) const;

 private:
  /// Begin of a straight piece: δ, L(δ), ∫₀^δ L dδ, and the slope of the piece.
  struct Knot {
    double deformation, force, energy, slope;
  };
  /// The piece in which δ ≥ 0 lies.
  const Knot& PieceOf(double deformation) const;
  /// L and its slope.
  Power Loading(double deformation) const;
  /// k_u of what has turned under this force [N/m].
  double Back(double force) const { return unloading_.stiffness + unloading_.stiffening * force; }

  // The last piece has no end. Copies of a contact share them.
  std::shared_ptr<const std::vector<Knot>> knots_;
  Unloading unloading_;
};

}  // namespace contact
