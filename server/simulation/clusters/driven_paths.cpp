#include "simulation/clusters/driven_paths.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "simulation/model/derived.h"

namespace contact {

// Displacements are summed from piece to piece: positions would lose their digits.
DrivenPaths::DrivenPaths(const Scenario& scenario)
    : rows_(scenario.drives), paths_(scenario.bodies.size()) {
  for (const std::span<const Drive> row : rows_.rows()) {
    Path& path = paths_[At(row.front().body)];
    assert(path.pieces.empty());  // All pieces of a body follow one another.
    path.pieces = row;
    double u = 0;
    for (const Drive& piece : row) {
      path.begins.push_back(u);
      u += Displacement(piece, piece.begin, piece.end);
    }
    FindBounds(scenario.end_time, &path);
  }
}

// A piece is above its chord by at most h²/8 of the largest |ẍ|, and a sine by its amplitude above
// its middle.
void DrivenPaths::FindBounds(double end_time, Path* path) {
  const std::size_t count = path->pieces.size();
  path->most.assign(count, -kNever);
  path->least.assign(count, kNever);
  for (std::size_t i = count; i-- > 0;) {
    if (i + 1 < count) path->most[i] = path->most[i + 1], path->least[i] = path->least[i + 1];
    Drive steady = path->pieces[i];
    const double swing = 2 * std::abs(std::exchange(steady.amplitude, 0));
    const double h = std::min(steady.end, end_time) - steady.begin;
    if (h < 0) continue;
    const double bend =
        std::max(std::abs(steady.acceleration), std::abs(steady.acceleration + steady.jerk * h));
    const double begin = path->begins[i];
    const double end = begin + Displacement(steady, steady.begin, steady.begin + h);
    const double beside = swing + h * h / 8 * bend;
    path->most[i] = std::max(path->most[i], std::max(begin, end) + beside);
    path->least[i] = std::min(path->least[i], std::min(begin, end) - beside);
  }
}

// One begins at 0.
std::size_t DrivenPaths::PlaceAt(int body, double instant) const {
  const auto begun = PieceRows<Drive>::Begun(paths_[At(body)].pieces, instant);
  return begun.empty() ? 0 : begun.size() - 1;
}

Place DrivenPaths::PlaceOf(int body, double instant) const {
  if (!Moves(body)) return {};
  const std::size_t place = PlaceAt(body, instant);
  const Path& path = paths_[At(body)];
  const Drive& piece = path.pieces[place];
  return {path.begins[place] + Displacement(piece, piece.begin, instant),
          MotionAt(piece, instant).velocity};
}

double DrivenPaths::MostDisplacement(int body, double sign, double from) const {
  if (!Moves(body)) return 0;
  const Path& path = paths_[At(body)];
  const std::size_t place = PlaceAt(body, from);
  return sign > 0 ? path.most[place] : -path.least[place];
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
