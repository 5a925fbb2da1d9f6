#include "base/histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace contact {

Histogram::Histogram(std::vector<double> bounds)
    : bounds_(std::move(bounds)), counts_(bounds_.size() + 1) {}

void Histogram::Count(double value) {
  const auto bucket = std::ranges::lower_bound(bounds_, value) - bounds_.begin();
  ++counts_[static_cast<std::size_t>(bucket)];
  sum_ += value;
}

Histogram::Snapshot Histogram::Get() const {
  return {bounds_, {counts_.begin(), counts_.end()}, sum_};
}

std::vector<double> DecadeBounds(int first, int last) {
  std::vector<double> bounds;
  for (int power = first; power < last; ++power) {
    for (const double digits : {1.0, 2.5, 5.0}) bounds.push_back(digits * std::pow(10, power));
  }
  bounds.push_back(std::pow(10, last));
  return bounds;
}

}  // namespace contact
