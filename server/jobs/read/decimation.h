#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace contact {

/// Thins a series of rows so that no peak is lost: cuts it into stretches of equally many rows and
/// keeps, of each, the rows in which some channel is smallest or largest; and the first and last
/// row of all. As long as all rows fit, all are kept.
///
/// The stretches grow while rows come in, so memory does not, and nothing need be known about the
/// length of the series before.
class MinMaxDecimator {
 public:
  /// The columns of a table, each with the values that FrameChunk::Column::values has.
  using Table = std::span<const std::string_view>;

  /// For rows of `columns` ≥ 1 values, the first of which is the time and has no peaks. Keeps at
  /// most `max_rows` ≥ 2 · columns.
  MinMaxDecimator(std::size_t columns, std::size_t max_rows);

  /// Adds rows of finite values: `count` rows of the table from row `first` on.
  void Add(Table table, std::size_t first, std::size_t count);

  /// The rows kept, one after the other, in the order in which they came.
  std::vector<double> Rows() const;

 private:
  /// Whole rows, one after the other.
  using Values = std::vector<double>;

  /// Adds rows to the stretch that is being filled, of which it has room for all.
  void Fill(Table table, std::size_t first, std::size_t count);
  /// Ends the stretch that is being filled.
  void Close();
  /// Makes one stretch of every two. The last one without a partner is open again.
  void Widen();
  /// The rows in which some channel is smallest or largest; also the first or last one if asked.
  Values Extremes(std::span<const double> rows, bool first, bool last) const;
  std::size_t closed_rows() const { return closed_.size() / columns_; }

  const std::size_t columns_;
  /// Rows that stretches may keep.
  const std::size_t budget_;
  /// Rows that one stretch keeps at most, beside the very first.
  const std::size_t most_;
  /// Rows in a stretch.
  std::size_t width_ = 1;
  /// Rows that the full stretches keep.
  Values closed_;
  /// Where the rows of each full stretch end in closed_.
  std::vector<std::size_t> ends_;
  /// Rows of the stretch that is being filled, at least those to keep; the last one is the newest
  /// of all.
  Values open_;
  /// Rows that came into the stretch that is being filled.
  std::size_t filled_ = 0;
};

}  // namespace contact
