#include "jobs/read/page_tokens.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

namespace contact {
namespace {

TEST(PageTokens, OpenIsTheInverseOfSeal) {
  const PageTokens tokens("secret");
  for (const std::int64_t position :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{42}, INT64_MAX}) {
    EXPECT_EQ(tokens.Open("acme", tokens.Seal("acme", position)), position);
  }
  EXPECT_EQ(tokens.Seal("acme", 0), "");
}

TEST(PageTokens, AreGoodForWhoeverKnowsTheSecretAndTheTenant) {
  const std::string token = PageTokens("secret").Seal("acme", 42);
  EXPECT_EQ(PageTokens("secret").Open("acme", token), 42);
  EXPECT_LT(PageTokens("another").Open("acme", token), 0);
  EXPECT_LT(PageTokens("secret").Open("umbra", token), 0);
  EXPECT_LT(PageTokens("secret").Open("", token), 0);
}

TEST(PageTokens, NoOtherTextIsOne) {
  const PageTokens tokens("secret");
  const std::string good = tokens.Seal("acme", 42);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = bad[i] == '0' ? '1' : '0';
    EXPECT_LT(tokens.Open("acme", bad), 0) << bad;
  }
  for (const std::string& bad : {std::string("42"), std::string(32, '0'), std::string(32, 'g'),
                                 std::string(32, '\0'), good + "0", " " + good}) {
    EXPECT_LT(tokens.Open("acme", bad), 0) << bad;
  }
}

// Neighbours have nothing in common.
TEST(PageTokens, TellNothingOfTheirPosition) {
  const PageTokens tokens("secret");
  std::set<std::string> beginnings, ends;
  for (int position = 1; position <= 1000; ++position) {
    const std::string token = tokens.Seal("acme", position);
    ASSERT_EQ(token.size(), 32U);
    beginnings.insert(token.substr(0, 16));
    ends.insert(token.substr(16));
  }
  EXPECT_EQ(beginnings.size(), 1000U);
  EXPECT_EQ(ends.size(), 1000U);
}

}  // namespace
}  // namespace contact
