#include "identity/principal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>
#include <utility>

namespace contact {
namespace {

constexpr std::array<std::pair<Role, const char*>, 5> kRoles = {{{Role::kRead, "read"},
                                                                 {Role::kSubmit, "submit"},
                                                                 {Role::kOperator, "operator"},
                                                                 {Role::kAdmin, "admin"},
                                                                 {Role::kServer, "server"}}};

bool IsName(std::string_view text) {
  return !text.empty() && text.size() <= 64 && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '@' || c == '-';
  });
}

// The least role that has the permission.
Role LeastRole(Permission permission) { return static_cast<Role>(permission); }
static_assert(static_cast<int>(Permission::kServer) == static_cast<int>(Role::kServer));

bool ReadRoles(const std::string& text, std::set<Role>* roles, std::string* mistake) {
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<Role> role = FindRole(word);
    if (!role) {
      *mistake = "'" + word + "' is no role; there are read, submit, operator, admin and server";
      return false;
    }
    roles->insert(*role);
  }
  return true;
}

}  // namespace

const Principal& LocalPrincipal() {
  static const Principal kEverybody{kLocal, kLocal, {Role::kAdmin, Role::kServer}, "local"};
  return kEverybody;
}

Principal SocketAdmin() { return {"admin", kLocal, LocalPrincipal().roles, "socket"}; }

bool May(const Principal& principal, Permission permission) {
  if (permission == Permission::kServer) return principal.roles.contains(Role::kServer);
  return std::ranges::any_of(principal.roles, [permission](Role role) {
    return role != Role::kServer && role >= LeastRole(permission);
  });
}

bool IsKnownAdmin(const Principal& principal) {
  return principal.how != kLocal && May(principal, Permission::kAdmin);
}

const char* NameOf(Role role) { return kRoles.at(static_cast<std::size_t>(role)).second; }

std::optional<Role> FindRole(std::string_view name) {
  for (const auto& [role, word] : kRoles) {
    if (name == word) return role;
  }
  return std::nullopt;
}

const char* NameOf(Permission permission) { return NameOf(LeastRole(permission)); }

std::optional<Principal> ParsePrincipal(const std::string& text, std::string* mistake) {
  std::map<std::string, std::string> parts;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    const std::string key = word.substr(0, colon);
    const bool known = key == "user" || key == "tenant" || key == "roles";
    if (colon == std::string::npos || !known || parts.contains(key)) {
      *mistake = "'" + word + "' is none of user:NAME, tenant:NAME and roles:ROLE, each once";
      return std::nullopt;
    }
    parts[key] = word.substr(colon + 1);
  }
  Principal principal{parts["user"], parts["tenant"], {}, ""};
  if (!ReadRoles(parts["roles"], &principal.roles, mistake)) return std::nullopt;
  const bool server = principal.roles == std::set<Role>{Role::kServer};
  if (!IsName(principal.name) || !(server || IsName(principal.tenant))) {
    *mistake = "user and tenant need names of 1 to 64 letters, digits and ._@-";
  } else if (principal.roles.empty()) {
    *mistake = "roles are missing";
  } else if (principal.roles.contains(Role::kServer) && !(server && principal.tenant.empty())) {
    *mistake = "the role server is alone and of no tenant: user:NAME roles:server";
  } else {
    return principal;
  }
  return std::nullopt;
}

std::string FormatPrincipal(const Principal& principal) {
  const std::string tenant = principal.tenant.empty() ? "" : " tenant:" + principal.tenant;
  std::string text = "user:" + principal.name + tenant + " roles:";
  for (const Role role : principal.roles) {
    if (!text.ends_with(':')) text += ',';
    text += NameOf(role);
  }
  return text;
}

}  // namespace contact
