#include "identity/token_table.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>

#include "identity/hex.h"
#include "table_of.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using std::chrono::system_clock;

const system_clock::time_point kNow = system_clock::from_time_t(1'800'000'000);
const Principal kCi{"ci", "acme", {Role::kSubmit}, ""};

std::string Words(const TokenTable& table, const std::string& token) {
  const auto found = table.Find(token, kNow);
  const auto* words = std::get_if<std::string>(&found);
  return words == nullptr ? "" : *words;
}

TEST(TokenTableTest, TokenGivesItsPrincipal) {
  const NewToken made = MakeToken(kCi, kNow + 1s);
  const auto found = TableOf({made.record}).Find(made.token, kNow);
  ASSERT_TRUE(std::holds_alternative<Principal>(found)) << std::get<std::string>(found);
  EXPECT_EQ(std::get<Principal>(found),
            (Principal{"ci", "acme", {Role::kSubmit}, "token", made.record.id}));
}

TEST(TokenTableTest, EveryOtherTokenIsRefused) {
  const NewToken good = MakeToken(kCi, kNow + 1s);
  const NewToken expired = MakeToken(kCi, kNow);
  NewToken revoked = MakeToken(kCi, kNow + 1s);
  revoked.record.revoked = true;
  const TokenTable table = TableOf({good.record, expired.record, revoked.record});
  std::string other = good.token;
  other.back() = other.back() == 'a' ? 'b' : 'a';
  EXPECT_NE(Words(table, expired.token).find("expired at 2027-01-15T08:00:00Z"), std::string::npos);
  EXPECT_NE(Words(table, revoked.token).find("was revoked"), std::string::npos);
  const std::string unknown = Words(table, MakeToken(kCi, kNow + 1s).token);
  EXPECT_EQ(Words(table, other), unknown)
      << "who lacks the secret does not learn that the id exists";
  for (const std::string& bad :
       {std::string(), std::string("ctk_"), good.token + "x", good.token.substr(1),
        std::string(10'000, 'x'), good.record.sha256}) {
    EXPECT_EQ(Words(table, bad), unknown);
  }
}

TEST(TokenTableTest, FileHoldsNoTokenAndWordsDoNotEither) {
  const NewToken made = MakeToken(kCi, kNow);
  const std::string secret = made.token.substr(made.token.rfind('_') + 1);
  EXPECT_EQ(secret.size(), 43U);
  EXPECT_EQ(TokenTable::Format({made.record}).find(secret), std::string::npos);
  EXPECT_EQ(Words(TableOf({made.record}), made.token).find(secret), std::string::npos);
  EXPECT_EQ(made.record.sha256, Sha256Hex(made.token));
}

TEST(TokenTableTest, TokensAreDifferent) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(MakeToken(kCi, kNow).token);
  EXPECT_EQ(tokens.size(), 100U);
}

TEST(TokenTableTest, MistakeIsToldWithItsLine) {
  const std::string good = TokenTable::Format({MakeToken(kCi, kNow).record});  // Two lines.
  const std::string line = good.substr(good.find('\n') + 1);
  for (const std::string& bad :
       {std::string("x"), line,
        "a " + std::string(64, '0') + " 0027-01-15T08:00:00Z valid user:a tenant:b roles:read",
        "a " + std::string(64, '0') + " never valid user:a tenant:b roles:read",
        std::string("a 00 2027-01-15T08:00:00Z valid user:a tenant:b roles:read"),
        "a " + std::string(64, '0') + " 2027-01-15T08:00:00Z maybe user:a tenant:b roles:read",
        "a " + std::string(64, '0') + " 2027-01-15T08:00:00Z valid user:a"}) {
    const auto table = TokenTable::Parse(good + bad);
    const auto* mistake = std::get_if<std::string>(&table);
    ASSERT_NE(mistake, nullptr) << bad;
    EXPECT_TRUE(mistake->starts_with("line 3: ")) << *mistake;
  }
}

}  // namespace
}  // namespace contact
