#include "base/resident_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace contact {
namespace {

TEST(ResidentMemory, GrowsWithWhatIsUsed) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const std::int64_t before = ResidentMemory();
  EXPECT_GT(before, 0);
  const std::vector<char> used(kBytes, 'x');
  EXPECT_GT(ResidentMemory() - before, std::int64_t{kBytes} * 9 / 10) << used[kBytes / 2];
}

}  // namespace
}  // namespace contact
