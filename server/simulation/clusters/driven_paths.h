#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/clusters/flight.h"
#include "simulation/model/index.h"
#include "simulation/model/piece_rows.h"
#include "simulation/model/scenario.h"

namespace contact {

/// Where the driven bodies of a scenario are, (M7).
class DrivenPaths {
 public:
  /// The scenario must outlive the paths.
  explicit DrivenPaths(const Scenario& scenario);

  /// Whether a drive moves the body, which may be kNone.
  bool Moves(int body) const { return body != kNone && !paths_[At(body)].pieces.empty(); }
  /// The pieces of the motion of a body from an instant on, in the order of time.
  std::span<const Drive> PiecesFrom(int body, double instant) const {
    return Moves(body) ? paths_[At(body)].pieces.subspan(PlaceAt(body, instant))
                       : std::span<const Drive>();
  }

  /// Where a body is at an instant [s]. What no drive moves is at 0.
  Place PlaceOf(int body, double instant) const;
  /// ẍ of it then [m/s²].
  double AccelerationOf(int body, double instant) const;
  /// The next instant at which another piece begins [s]; kNever if none does.
  double NextBreak(int body, double instant) const;
  /// The largest u · sign of a body from an instant to the end of the run [m], or somewhat more.
  double MostDisplacement(int body, double sign, double from) const;
  /// The largest ẍ · sign of a body between two instants of one piece [m/s²], or somewhat more.
  double MostAcceleration(int body, double sign, double from, double to) const;

 private:
  struct Path {
    std::span<const Drive> pieces;
    std::vector<double> begins;       // u where each piece begins [m],
    std::vector<double> most, least;  // and its bounds from there to the end of the run.
  };
  std::size_t PlaceAt(int body, double instant) const;
  const Drive& PieceAt(int body, double instant) const {
    return paths_[At(body)].pieces[PlaceAt(body, instant)];
  }
  static void FindBounds(double end_time, Path* path);

  const PieceRows<Drive> rows_;
  std::vector<Path> paths_;  // Of each body.
};

}  // namespace contact
