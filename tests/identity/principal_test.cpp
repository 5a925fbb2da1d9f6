#include "identity/principal.h"

#include <gtest/gtest.h>

#include <string>

namespace contact {
namespace {

TEST(PrincipalTest, EveryRoleIncludesThoseBeforeIt) {
  const std::set<Role> roles = {Role::kRead, Role::kSubmit, Role::kOperator, Role::kAdmin};
  const std::set<Permission> permissions = {Permission::kRead, Permission::kSubmit,
                                            Permission::kChangeAny, Permission::kAdmin};
  for (const Role role : roles) {
    for (const Permission permission : permissions) {
      const Principal principal{"a", "t", {role}, ""};
      EXPECT_EQ(May(principal, permission), static_cast<int>(role) >= static_cast<int>(permission))
          << NameOf(role) << ' ' << NameOf(permission);
    }
  }
  EXPECT_FALSE(May(Principal{"a", "t", {}, ""}, Permission::kRead)) << "no role, no permission";
}

TEST(PrincipalTest, WhoCopiesTheStoreIsOfNoTenant) {
  std::string mistake;
  const auto server = ParsePrincipal("user:backup roles:server", &mistake);
  ASSERT_TRUE(server) << mistake;
  EXPECT_EQ(ParsePrincipal(FormatPrincipal(*server), &mistake), server);
  EXPECT_TRUE(May(*server, Permission::kServer));
  for (const Permission permission : {Permission::kRead, Permission::kSubmit, Permission::kAdmin}) {
    EXPECT_FALSE(May(*server, permission)) << NameOf(permission);
  }
  EXPECT_FALSE(May(Principal{"a", "t", {Role::kAdmin}, ""}, Permission::kServer));
  EXPECT_TRUE(May(LocalPrincipal(), Permission::kServer));
  EXPECT_TRUE(May(SocketAdmin(), Permission::kServer));
  for (const char* text : {"user:a tenant:t roles:server", "user:a tenant:t roles:admin,server",
                           "user:a roles:admin"}) {
    EXPECT_FALSE(ParsePrincipal(text, &mistake)) << text;
  }
}

TEST(PrincipalTest, TextIsReadBack) {
  std::string mistake;
  const auto principal = ParsePrincipal(" user:ci@lab tenant:acme  roles:submit,read ", &mistake);
  ASSERT_TRUE(principal) << mistake;
  EXPECT_EQ(principal->name, "ci@lab");
  EXPECT_EQ(principal->tenant, "acme");
  EXPECT_EQ(principal->roles, (std::set{Role::kRead, Role::kSubmit}));
  EXPECT_EQ(ParsePrincipal(FormatPrincipal(*principal), &mistake), principal);
}

TEST(PrincipalTest, EveryOtherTextIsRefusedWithAReason) {
  for (const char* text :
       {"", "user:a", "user:a tenant:b", "user:a tenant:b roles:", "user:a tenant:b roles:root",
        "user:a tenant:b roles:read extra", "user:a user:b tenant:c roles:read",
        "user:a/b tenant:c roles:read", "user:a tenant: roles:read", "user:$1 tenant:c roles:read",
        "user:a tenant:b roles:read host:c"}) {
    std::string mistake;
    EXPECT_FALSE(ParsePrincipal(text, &mistake)) << text;
    EXPECT_NE(mistake, "") << text;
  }
}

}  // namespace
}  // namespace contact
