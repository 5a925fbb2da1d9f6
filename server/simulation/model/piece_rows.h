#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace contact {

/// Pieces of loads or drives by their times. Neighbours of one body that follow one another, as the
/// pieces of a table do, are a row, in which a piece is found by bisection; of 10⁶ pieces of a
/// table a step must not look at all.
template <class Piece>
class PieceRows {
 public:
  /// The pieces must outlive the rows.
  explicit PieceRows(const std::vector<Piece>& pieces) {
    const std::span<const Piece> all(pieces);
    std::size_t first = 0;
    for (std::size_t i = 1; i <= all.size(); ++i) {
      const bool follows = i < all.size() && all[i].body == all[i - 1].body &&
                           all[i].begin >= all[i - 1].end && all[i].end > all[i].begin;
      if (follows) continue;
      rows_.push_back(all.subspan(first, i - first));
      first = i;
    }
  }

  /// The rows, in the order of their pieces.
  const std::vector<std::span<const Piece>>& rows() const { return rows_; }

  /// The pieces of a row that have begun at `time`.
  static std::span<const Piece> Begun(std::span<const Piece> row, double time) {
    const auto next = std::ranges::upper_bound(row, time, {}, &Piece::begin);
    return row.first(static_cast<std::size_t>(next - row.begin()));
  }

  /// The piece of a row that acts at `time`; null if none does.
  static const Piece* At(std::span<const Piece> row, double time) {
    const std::span<const Piece> begun = Begun(row, time);
    return begun.empty() || begun.back().end <= time ? nullptr : &begun.back();
  }

 private:
  std::vector<std::span<const Piece>> rows_;
};

}  // namespace contact
