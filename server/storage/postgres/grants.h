#pragma once

#include <string>

namespace contact::postgres {

/// Roles of PostgreSQL that processes connect as; empty: none.
struct Grants {
  std::string front = {};
  std::string worker = {};
  std::string launcher = {};
};

/// The statements that let each role call the functions that it needs, and nothing else: no role
/// may read or write a table. They run as the owner of the schema. Empty: there are no roles.
std::string GrantScript(const Grants& grants);

}  // namespace contact::postgres
