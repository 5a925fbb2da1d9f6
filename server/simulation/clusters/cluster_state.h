#pragma once

#include <cstdint>
#include <vector>

#include "simulation/clusters/piece.h"

namespace contact {

/// All that a run in clusters needs beside RunState to go on: plain values, so that a checkpoint
/// can keep them.
struct ClusterState {
  /// World::Station, with the number of its piece; 0: it flies or waits.
  struct Station {
    double from = 0;
    std::int64_t piece = 0;
    Flight flight;
  };
  std::vector<Piece> pieces;                   ///< Told in part: they go on after State::time.
  std::vector<std::vector<Station>> stations;  ///< Of each body.
  std::vector<Waiting> waiting;                ///< Each group that waits.
  std::int64_t number = 0;                     ///< Of the last piece that was tried,
  std::int64_t look_at = 0;                    ///< and at which to look what is certain.
  std::vector<std::vector<int>> blocks;        ///< Bodies that stay together for good.
  std::int64_t useful = 0, wasted = 0;         ///< Steps since bodies were bound last.
  double dissipated = 0;                       ///< In forgotten pieces, as samples tell it [J].
  double loss = 0;                             ///< Dissipated in pieces [J].
  double work = 0;                             ///< Of what is not steady, in pieces [J],
  double impulse = 0;                          ///< and its impulse, with that of walls [N·s].
};

}  // namespace contact
