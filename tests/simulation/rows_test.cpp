#include "simulation/methods/rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace contact {
namespace {

TEST(InRows, TakesEveryRowOnceWhateverTheirNumber) {
  for (std::ptrdiff_t n = 0; n <= 40; ++n) {
    // One more than there are, which must stay as it is.
    std::vector<double> from(static_cast<std::size_t>(n) + 1), to(from.size(), -1);
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<double>(i);
    std::vector<int> taken(from.size());
    InRows(n, [&](auto rows, std::ptrdiff_t i) {
      using Array = typename decltype(rows)::Array;
      for (std::ptrdiff_t j = i; j < i + Array::SizeAtCompileTime; ++j) {
        ++taken[static_cast<std::size_t>(j)];
      }
      rows(to.data() + i) = 2 * rows(static_cast<const double*>(from.data()) + i);
    });
    for (std::size_t i = 0; i < from.size(); ++i) {
      const bool inside = i + 1 < from.size();
      EXPECT_EQ(taken[i], inside ? 1 : 0) << n;
      EXPECT_EQ(to[i], inside ? 2 * from[i] : -1) << n;
    }
  }
}

TEST(WithCount, CallsOnceWithTheNumberAndKnowsThoseNamed) {
  for (std::ptrdiff_t n = 0; n <= 8; ++n) {
    int calls = 0;
    WithCount<2, 4, 6>(n, [&](auto count) {
      ++calls;
      EXPECT_EQ(count, n);
      const bool known = !std::is_same_v<decltype(count), std::ptrdiff_t>;
      EXPECT_EQ(known, n == 2 || n == 4 || n == 6);
    });
    EXPECT_EQ(calls, 1);
  }
}

}  // namespace
}  // namespace contact
