#include "simulation/clusters/driven_paths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulation/model/derived.h"

namespace contact {

// Displacements are summed from piece to piece: positions would lose their digits.
DrivenPaths::DrivenPaths(const Scenario& scenario)
    : rows_(scenario.drives), paths_(scenario.bodies.size()) {
  for (const std::span<const Drive> row : rows_.rows()) {
    Path& path = paths_[At(row.front().body)];
    path.pieces = row;
    double u = 0;
    for (const Drive& piece : row) {
      path.begins.push_back(u);
      u += Displacement(piece, piece.begin, piece.end);
    }
  }
}

// One begins at 0.
const Drive& DrivenPaths::PieceAt(int body, double instant) const {
  const std::span<const Drive> pieces = paths_[At(body)].pieces;
  const auto begun = PieceRows<Drive>::Begun(pieces, instant);
  return begun.empty() ? pieces.front() : begun.back();
}

Place DrivenPaths::PlaceOf(int body, double instant) const {
  if (!Moves(body)) return {};
  const Path& path = paths_[At(body)];
  const Drive& piece = PieceAt(body, instant);
  const double begin = path.begins[static_cast<std::size_t>(&piece - path.pieces.data())];
  return {begin + Displacement(piece, piece.begin, instant), MotionAt(piece, instant).velocity};
}

double DrivenPaths::AccelerationOf(int body, double instant) const {
  return Moves(body) ? MotionAt(PieceAt(body, instant), instant).acceleration : 0;
}

double DrivenPaths::NextBreak(int body, double instant) const {
  return Moves(body) ? PieceAt(body, instant).end : kNever;
}

double DrivenPaths::MostAcceleration(int body, double sign, double from, double to) const {
  if (!Moves(body)) return 0;
  const Drive& piece = PieceAt(body, from);
  const auto steady = [&](double t) {
    return sign * (piece.acceleration + piece.jerk * (t - piece.begin));
  };
  const double w = piece.angular_frequency;
  return std::max(steady(from), steady(to)) + w * w * std::abs(piece.amplitude);
}

}  // namespace contact
