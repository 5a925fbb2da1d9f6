#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace contact {

/// What a principal is for. Each role of a tenant includes those before it; kServer is of none.
enum class Role { kRead, kSubmit, kOperator, kAdmin, kServer };

/// What a call needs.
enum class Permission {
  /// To read jobs and what they recorded.
  kRead,
  /// To create jobs, and to cancel and delete own ones.
  kSubmit,
  /// To cancel and delete jobs of others of the tenant.
  kChangeAny,
  /// To have the places that are kept for admins.
  kAdmin,
  /// To copy the store, with the jobs of all tenants.
  kServer,
};

/// Who makes a call. See the contract's Principal.
struct Principal {
  /// Owner of the jobs that it creates.
  std::string name;
  /// Only jobs of this tenant are there for it. Empty: it has the role kServer alone.
  std::string tenant;
  /// Not empty.
  std::set<Role> roles;
  /// How it is known: `local`, `token`, `jwt`, `certificate`, `socket` or `proxy`.
  std::string how;
  /// Id of the token that it has shown; empty: none.
  std::string token_id = {};

  bool operator==(const Principal&) const = default;
};

/// Name and tenant of everybody on a server that asks for no identity, and of the jobs that were
/// created before jobs had owners.
inline constexpr char kLocal[] = "local";

/// Everybody on a server that asks for no identity, and who uses the socket file for admins: may do
/// all.
const Principal& LocalPrincipal();
Principal SocketAdmin();

/// True if a role of the principal gives it the permission.
bool May(const Principal& principal, Permission permission);

/// True for an admin of a server that asks who calls. Where nobody is asked everybody is admin.
bool IsKnownAdmin(const Principal& principal);

/// Their names in files, flags and answers: `read`, `submit`, `operator`, `admin`, `server`.
const char* NameOf(Role role);
std::optional<Role> FindRole(std::string_view name);
/// The name of the least role with the permission.
const char* NameOf(Permission permission);

/// Reads `user:NAME tenant:NAME roles:ROLE[,ROLE…]`, or `user:NAME roles:server`. Names have 1 to
/// 64 letters, digits and `._@-`. Nothing, with the reason in `mistake`, for another text. Without
/// `how`.
std::optional<Principal> ParsePrincipal(const std::string& text, std::string* mistake);
/// The text that ParsePrincipal reads.
std::string FormatPrincipal(const Principal& principal);

}  // namespace contact
