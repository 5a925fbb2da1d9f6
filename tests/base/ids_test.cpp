#include "base/sources.h"

#include <gmock/gmock.h>

#include <set>

namespace contact {
namespace {

TEST(RandomIds, AreShortReadableAndDifferent) {
  std::set<std::string> ids;
  for (int i = 0; i < 10'000; ++i) {
    const std::string id = RandomIds().NextJobId();
    EXPECT_THAT(id, testing::MatchesRegex("[0-9abcdefghjkmnpqrstvwxyz]{10}"));
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 10'000U);
}

}  // namespace
}  // namespace contact
