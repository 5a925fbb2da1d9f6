#include "identity/door.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace contact {
namespace {

using namespace std::chrono_literals;
using std::chrono::system_clock;

const system_clock::time_point kKnocked = system_clock::from_time_t(1'800'000'000);
const NewToken kGood = MakeToken({"ci", "acme", {Role::kSubmit}, ""}, kKnocked + 1s);
const NewToken kExpired = MakeToken({"ci", "acme", {Role::kSubmit}, ""}, kKnocked - 1s);

// Tokens and rules of a test.
struct FakeSource final : IdentitySource {
  bool has_tokens = true;
  bool has_rules = true;
  std::shared_ptr<const TokenTable> tokens() const override {
    if (!has_tokens) return nullptr;
    return std::make_shared<const TokenTable>(std::get<TokenTable>(
        TokenTable::Parse(TokenTable::Format({kGood.record, kExpired.record}))));
  }
  std::shared_ptr<const CertificateRules> rules() const override {
    if (!has_rules) return nullptr;
    return std::make_shared<const CertificateRules>(std::get<CertificateRules>(
        CertificateRules::Parse("cert cn:ada user:ada tenant:lab roles:read")));
  }
};

// `token`, `certificate`, or the words of the refusal.
std::string Decide(const Door& door, const Presented& presented) {
  const auto known = door.Identify(presented, kKnocked);
  const auto* principal = std::get_if<Principal>(&known);
  return principal == nullptr ? std::get<std::string>(known) : principal->how;
}

TEST(DoorTest, OpenDoorTakesEverybodyForItsPrincipal) {
  EXPECT_EQ(Decide(Door(), {}), "local");
  EXPECT_EQ(Decide(Door(), {{"Bearer nonsense"}, {"cn:nobody"}}), "local");
  EXPECT_EQ(Decide(Door(Principal{"ci", "t", {Role::kRead}, "socket"}), {}), "socket");
}

TEST(DoorTest, EveryTokenWithEveryCertificate) {
  const std::string good = "Bearer " + kGood.token;
  const std::string expired = "Bearer " + kExpired.token;
  struct Row {
    std::string token, certificate, decision;
  };
  const std::vector<Row> rows = {
      {"", "", "this server asks who calls; show a token or a client certificate"},
      {"", "cn:eve", "no rule of this server knows the client certificate"},
      {"", "cn:ada", "certificate"},
      {good, "", "token"},
      {good, "cn:eve", "token"},
      {good, "cn:ada", "token"},
      {"Bearer x", "", "the token is not known here"},
      {"Bearer x", "cn:ada", "the token is not known here"},
      {expired, "cn:ada", "the token " + kExpired.record.id + " expired at 2027-01-15T07:59:59Z"},
      {"Basic eDp5", "cn:ada", "authorization must be one 'Bearer TOKEN'"},
      {kGood.token, "cn:ada", "authorization must be one 'Bearer TOKEN'"},
  };
  const Door door(std::make_shared<const FakeSource>());
  for (const Row& row : rows) {
    Presented presented;
    if (!row.token.empty()) presented.authorization.push_back(row.token);
    if (!row.certificate.empty()) presented.certificate.push_back(row.certificate);
    EXPECT_EQ(Decide(door, presented), row.decision) << row.certificate;
  }
  EXPECT_EQ(Decide(door, {{good, expired}, {}}), "authorization must be one 'Bearer TOKEN'");
}

TEST(DoorTest, WithoutTokensOnlyTheCertificateCounts) {
  FakeSource source;
  source.has_tokens = false;
  const Door door(std::make_shared<const FakeSource>(source));
  EXPECT_EQ(Decide(door, {{"Bearer " + kGood.token}, {"cn:ada"}}), "certificate");
  source.has_rules = false;
  const Door closed(std::make_shared<const FakeSource>(source));
  EXPECT_EQ(Decide(closed, {{"Bearer " + kGood.token}, {"cn:ada"}}),
            "this server asks who calls; show a token or a client certificate");
}

TEST(DoorTest, ProxyAloneSaysWhoCalls) {
  const std::string ada = "user:ada tenant:lab roles:read";
  const Door proxied{TrustedProxy()};
  EXPECT_EQ(Decide(proxied, {.principal = {ada}}), "proxy");
  EXPECT_EQ(Decide(proxied, {.principal = {ada, ada}}),
            "the proxy must name the caller in one x-contactd-principal");
  EXPECT_EQ(Decide(proxied, {{"Bearer " + kGood.token}, {"cn:ada"}}),
            "the proxy must name the caller in one x-contactd-principal");
  EXPECT_EQ(Decide(proxied, {.principal = {"user:ada tenant:lab"}}), "roles are missing");
  const Door asks(std::make_shared<const FakeSource>());
  EXPECT_EQ(Decide(asks, {.principal = {ada}}),
            "this server asks who calls; show a token or a client certificate");
  EXPECT_EQ(Decide(Door(), {.principal = {ada}}), "local");
}

}  // namespace
}  // namespace contact
