#include "jobs/read/decimation.h"

#include <algorithm>
#include <utility>

#include "wire/column_bytes.h"

namespace contact {
namespace {

// Rows that wait in the open stretch before they are looked through together.
constexpr std::size_t kMinWaiting = 64;

// The first of `count` rows with the smallest value, and with the largest. `value(row)` is one.
template <class Value>
std::pair<std::size_t, std::size_t> LowAndHigh(std::size_t count, const Value& value) {
  std::pair<std::size_t, std::size_t> rows;
  double low = value(0);
  double high = low;
  for (std::size_t row = 1; row < count; ++row) {
    const double now = value(row);
    if (now < low) {
      low = now;
      rows.first = row;
    }
    if (now > high) {
      high = now;
      rows.second = row;
    }
  }
  return rows;
}

// Appends those of `count` rows in which some channel is smallest or largest, and the first or last
// one if asked for. `value(row, column)` is a value of them.
template <class Value>
void AppendExtremes(std::size_t count, std::size_t columns, bool first, bool last,
                    const Value& value, std::vector<double>* kept) {
  std::vector<bool> keep(count);
  keep.front() = first;
  if (last) keep.back() = true;
  for (std::size_t column = 1; column < columns; ++column) {
    const auto [low, high] =
        LowAndHigh(count, [&value, column](std::size_t row) { return value(row, column); });
    keep[low] = keep[high] = true;
  }
  for (std::size_t row = 0; row < count; ++row) {
    if (!keep[row]) continue;
    for (std::size_t column = 0; column < columns; ++column) kept->push_back(value(row, column));
  }
}

}  // namespace

MinMaxDecimator::MinMaxDecimator(std::size_t columns, std::size_t max_rows)
    : columns_(columns), budget_(max_rows - 2), most_(2 * (columns - 1)) {}

void MinMaxDecimator::Add(Table table, std::size_t first, std::size_t count) {
  while (count > 0) {
    if (filled_ == width_) Close();
    const std::size_t some = std::min(count, width_ - filled_);
    Fill(table, first, some);
    first += some;
    count -= some;
  }
}

void MinMaxDecimator::Fill(Table table, std::size_t first, std::size_t count) {
  if (open_.size() / columns_ >= std::max(2 * most_, kMinWaiting)) {
    open_ = Extremes(open_, ends_.empty(), false);
  }
  const auto value = [&](std::size_t row, std::size_t column) {
    return DoubleAt(table[column], first + row);
  };
  AppendExtremes(count, columns_, filled_ == 0, true, value, &open_);
  filled_ += count;
}

std::vector<double> MinMaxDecimator::Rows() const {
  Values rows = closed_;
  if (open_.empty()) return rows;
  const Values last = Extremes(open_, ends_.empty(), true);
  rows.insert(rows.end(), last.begin(), last.end());
  return rows;
}

void MinMaxDecimator::Close() {
  const Values kept = Extremes(open_, ends_.empty(), false);
  closed_.insert(closed_.end(), kept.begin(), kept.end());
  ends_.push_back(closed_.size());
  open_.clear();
  filled_ = 0;
  while (closed_rows() + std::min(most_, width_) > budget_) Widen();
}

// Makes one stretch of every two. The last one without a partner is open again, with the rows that
// the Widen just before has left open.
void MinMaxDecimator::Widen() {
  const Values old = std::exchange(closed_, {});
  const std::vector<std::size_t> ends = std::exchange(ends_, {});
  const auto stretch = [&old](std::size_t begin, std::size_t end) {
    return std::span(old).subspan(begin, end - begin);
  };
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    const Values kept = Extremes(stretch(i == 0 ? 0 : ends[i - 1], ends[i + 1]), i == 0, false);
    closed_.insert(closed_.end(), kept.begin(), kept.end());
    ends_.push_back(closed_.size());
  }
  if (ends.size() % 2 == 1) {
    const auto last = stretch(ends.size() == 1 ? 0 : ends[ends.size() - 2], ends.back());
    open_.insert(open_.begin(), last.begin(), last.end());
    filled_ += width_;
  }
  width_ *= 2;
}

MinMaxDecimator::Values MinMaxDecimator::Extremes(std::span<const double> rows, bool first,
                                                  bool last) const {
  const auto value = [&](std::size_t row, std::size_t column) {
    return rows[row * columns_ + column];
  };
  Values kept;
  AppendExtremes(rows.size() / columns_, columns_, first, last, value, &kept);
  return kept;
}

}  // namespace contact
