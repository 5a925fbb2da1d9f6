#include "simulation/laws/force_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

namespace contact {

ForceTable::ForceTable(const std::vector<Point>& points, Unloading unloading)
    : unloading_(unloading) {
  assert(!points.empty());
  std::vector<Knot> knots;
  Knot knot{};
  for (const Point& point : points) {
    const double rise = point.force - knot.force, run = point.deformation - knot.deformation;
    assert(rise > 0 && run > 0);
    knot.slope = rise / run;
    knots.push_back(knot);
    knot.energy += (knot.force + point.force) / 2 * run;
    knot.deformation = point.deformation;
    knot.force = point.force;
  }
  knots.push_back(knot);  // On with the last slope.
  knots_ = std::make_shared<const std::vector<Knot>>(std::move(knots));
}

const ForceTable::Knot& ForceTable::PieceOf(double deformation) const {
  return *std::prev(std::ranges::upper_bound(knots_->begin() + 1, knots_->end(), deformation, {},
                                             &Knot::deformation));
}

Power ForceTable::Loading(double deformation) const {
  Power at(0, 1);
  if (deformation <= 0) return at;
  const Knot& piece = PieceOf(deformation);
  at.value = piece.force + piece.slope * (deformation - piece.deformation);
  at.slope = piece.slope;
  return at;
}

Power ForceTable::At(double deformation, double yield) const {
  if (!yields() || deformation >= yield) return Loading(deformation);
  Power at(0, 1);
  if (deformation <= 0) return at;
  const double most = Loading(yield).value, back = Back(most);
  const double force = most - back * (yield - deformation);
  if (force > 0) at.value = force, at.slope = back;
  return at;
}

double ForceTable::ByYield(double deformation, double yield) const {
  if (At(deformation, yield).value == 0 || !yields() || deformation >= yield) return 0;
  const Power most = Loading(yield);
  return most.slope * (1 - unloading_.stiffening * (yield - deformation)) - Back(most.value);
}

double ForceTable::Energy(double deformation, double yield) const {
  if (deformation <= 0) return 0;
  if (yields()) {
    const double force = At(deformation, yield).value;
    return force * force / (2 * Back(deformation < yield ? Loading(yield).value : force));
  }
  const Knot& piece = PieceOf(deformation);
  const double further = deformation - piece.deformation;
  return piece.energy + (piece.force + piece.slope * further / 2) * further;
}

double ForceTable::DepthUnder(double force) const {
  const auto next =
      std::ranges::upper_bound(knots_->begin() + 1, knots_->end(), force, {}, &Knot::force);
  const Knot& piece = *std::prev(next);
  return piece.deformation + (force - piece.force) / piece.slope;
}

// In a piece that begins at δ₀ the excess ∫L dδ − E − P δ is a parabola, whose larger root is
// sought.
double ForceTable::DepthOf(double energy, double force) const {
  const auto excess = [&](const Knot& knot) {
    return knot.energy - energy - force * knot.deformation;
  };
  const auto past = std::ranges::find_if(knots_->begin() + 1, knots_->end(),
                                         [&](const Knot& knot) { return excess(knot) > 0; });
  const Knot& piece = *std::prev(past);
  const double lack = -excess(piece), push = force - piece.force;
  return piece.deformation +
         (push + std::sqrt(std::max(0.0, push * push + 2 * piece.slope * lack))) / piece.slope;
}

}  // namespace contact
