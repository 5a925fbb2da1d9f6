#pragma once

#include <gmock/gmock.h>

namespace contact {

/// Matches a positive number within 5 % of this.
inline auto About(double value) {
  return testing::AllOf(testing::Ge(0.95 * value), testing::Le(1.05 * value));
}

}  // namespace contact
