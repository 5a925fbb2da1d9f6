#include "identity/certificate_rules.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace contact {
namespace {

CertificateRules Rules(const std::string& text) {
  auto rules = CertificateRules::Parse(text);
  if (const auto* mistake = std::get_if<std::string>(&rules)) ADD_FAILURE() << *mistake;
  return std::get<CertificateRules>(std::move(rules));
}

TEST(CertificateRulesTest, FirstRuleThatFitsTheWholeNameDecides) {
  struct Row {
    std::vector<std::string> names;
    std::string user, tenant;
  };
  const CertificateRules rules = Rules(
      "cert spiffe://acme/*/robot user:robot-$1 tenant:acme roles:operator\n"
      "cert spiffe://acme/user/* user:$1 tenant:acme roles:submit # people\n"
      "cert dns:*.lab.example user:$1 tenant:lab roles:read\n"
      "cert cn:ops user:ops tenant:local roles:admin\n");
  const std::vector<Row> rows = {
      {{"spiffe://acme/user/ada"}, "ada", "acme"},
      {{"spiffe://acme/user/robot"}, "robot-user", "acme"},
      {{"spiffe://acme/user/ada/x"}, "", ""},
      {{"spiffe://acme/user/"}, "", ""},
      {{"spiffe://acme/user/a b"}, "", ""},  // No name of a principal.
      {{"xspiffe://acme/user/ada"}, "", ""},
      {{"dns:node1.lab.example"}, "node1", "lab"},
      {{"dns:node1xlab.example"}, "", ""},
      {{"dns:a", "cn:ops"}, "ops", "local"},
      {{"cn:opsx"}, "", ""},
      {{}, "", ""},
  };
  for (const Row& row : rows) {
    const auto found = rules.Find(row.names).value_or(Principal{});
    EXPECT_EQ(found.name, row.user) << testing::PrintToString(row.names);
    EXPECT_EQ(found.tenant, row.tenant) << testing::PrintToString(row.names);
    EXPECT_EQ(found.how, row.user.empty() ? "" : "certificate");
  }
}

TEST(CertificateRulesTest, NobodyIsNobodyWhateverFollows) {
  const CertificateRules rules = Rules(
      "cert cn:mallory nobody\n"
      "cert cn:* user:$1 tenant:acme roles:submit\n");
  EXPECT_FALSE(rules.Find({"cn:mallory"}));
  EXPECT_TRUE(rules.Find({"cn:ada"}));
  EXPECT_TRUE(
      std::holds_alternative<std::string>(CertificateRules::Parse("cert cn:a nobody else")));
}

TEST(CertificateRulesTest, LongNamesFitNoRule) {
  EXPECT_FALSE(Rules("cert cn:* user:x tenant:t roles:read").Find({"cn:" + std::string(300, 'a')}));
}

TEST(CertificateRulesTest, MistakeIsToldWithItsLine) {
  for (const char* text :
       {"\ncert", "#\nuid 7 user:a tenant:b roles:read", "\ncert cn:a user:a tenant:b",
        "\ncert cn:a user:$1 tenant:b roles:read", "\ncert cn:* user:$2 tenant:b roles:read"}) {
    const auto rules = CertificateRules::Parse(text);
    const auto* mistake = std::get_if<std::string>(&rules);
    ASSERT_NE(mistake, nullptr) << text;
    EXPECT_TRUE(mistake->starts_with("line 2: ")) << *mistake;
  }
}

}  // namespace
}  // namespace contact
