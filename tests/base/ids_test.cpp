#include "base/ids.h"

#include <gmock/gmock.h>

#include <set>

namespace contact {
namespace {

TEST(RandomIdsTest, AreShortReadableAndDifferent) {
  std::set<std::string> ids;
  for (int i = 0; i < 10'000; ++i) {
    const std::string id = RandomIds().NextId();
    EXPECT_THAT(id, testing::MatchesRegex("[0-9abcdefghjkmnpqrstvwxyz]{10}"));
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 10'000U);
}

TEST(RandomIdsTest, UuidsHaveTheFormOfVersionFour) {
  const std::string first = RandomIds().NextUuid();
  EXPECT_THAT(first, testing::MatchesRegex(
                         "[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"));
  EXPECT_NE(RandomIds().NextUuid(), first);
}

}  // namespace
}  // namespace contact
