#include "jobs/read/decimation.h"

#include <algorithm>
#include <utility>

namespace contact {
namespace {

// Rows that wait in the open stretch before they are looked through together.
constexpr std::size_t kMinWaiting = 64;

}  // namespace

MinMaxDecimator::MinMaxDecimator(std::size_t columns, std::size_t max_rows)
    : columns_(columns), budget_(max_rows - 2), most_(2 * (columns - 1)) {}

void MinMaxDecimator::Add(std::span<const double> row) {
  if (filled_ == width_) Close();
  if (open_.size() / columns_ >= std::max(2 * most_, kMinWaiting)) {
    open_ = Extremes(open_, ends_.empty(), false);
  }
  open_.insert(open_.end(), row.begin(), row.end());
  ++filled_;
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

// Makes one stretch of every two. The last one without a partner is open again.
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
    open_.assign(last.begin(), last.end());
    filled_ = width_;
  }
  width_ *= 2;
}

// The rows in which some channel is smallest or largest, and the first or last one if asked for.
MinMaxDecimator::Values MinMaxDecimator::Extremes(std::span<const double> rows, bool first,
                                                  bool last) const {
  const std::size_t count = rows.size() / columns_;
  std::vector<bool> keep(count);
  keep.front() = first;
  if (last) keep.back() = true;
  for (std::size_t column = 1; column < columns_; ++column) {
    std::size_t low = 0;
    std::size_t high = 0;
    const auto value = [&](std::size_t row) { return rows[row * columns_ + column]; };
    for (std::size_t row = 1; row < count; ++row) {
      if (value(row) < value(low)) low = row;
      if (value(row) > value(high)) high = row;
    }
    keep[low] = keep[high] = true;
  }
  Values kept;
  for (std::size_t row = 0; row < count; ++row) {
    if (!keep[row]) continue;
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(row * columns_);
    kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(columns_));
  }
  return kept;
}

}  // namespace contact
