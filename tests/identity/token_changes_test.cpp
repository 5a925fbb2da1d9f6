#include "identity/token_changes.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "table_of.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

const std::chrono::system_clock::time_point kChanged(std::chrono::hours(500'000));
const Principal kAda{"ada", "acme", {Role::kSubmit}, ""};

// By id of the token.
std::map<std::string, std::string> Codes(const std::vector<AuditRecord>& records) {
  std::map<std::string, std::string> codes;
  for (const AuditRecord& record : records) codes[record.caller->token_id] += record.code;
  return codes;
}

TEST(TokenChanges, EachTokenThatIsMadeRevokedRemovedOrChangedHasItsLine) {
  std::vector<TokenRecord> records;
  for (int i = 0; i < 5; ++i) records.push_back(MakeToken(kAda, kChanged + 24h).record);
  records[4].revoked = true;
  const TokenTable before = TableOf(records);
  std::vector<TokenRecord> after = {records[0], records[1], records[3]};
  after[1].revoked = true;
  after[2].expires += 1h;
  after.push_back(MakeToken(kAda, kChanged + 24h).record);
  const auto lines = TokenChanges(&before, TableOf(after), "/etc/tokens", kChanged);
  EXPECT_EQ(Codes(lines), (std::map<std::string, std::string>{{records[1].id, "REVOKED"},
                                                              {records[2].id, "REMOVED"},
                                                              {records[3].id, "CHANGED"},
                                                              {after[3].id, "CREATED"}}));
  EXPECT_EQ(lines.front().caller->name, "ada");
  EXPECT_EQ(lines.front().peer, "file:/etc/tokens");
}

TEST(TokenChanges, StartListsTheTokensThatAreValid) {
  std::vector<TokenRecord> records;
  for (const auto left : {24h, 24h, 0h}) records.push_back(MakeToken(kAda, kChanged + left).record);
  records[1].revoked = true;
  EXPECT_EQ(Codes(TokenChanges(nullptr, TableOf(records), "f", kChanged)),
            (std::map<std::string, std::string>{{records[0].id, "VALID"}}));
  const TokenTable same = TableOf(records);
  EXPECT_TRUE(TokenChanges(&same, same, "f", kChanged).empty());
}

}  // namespace
}  // namespace contact
