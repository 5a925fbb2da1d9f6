#pragma once

#include <string>

namespace contact::postgres {

/// Roles of PostgreSQL that processes connect as; empty: none.
struct Grants {
  std::string front;
  std::string worker;
};

/// The statements that give the roles what they need: all tables to be read, none to be written,
/// and the functions that write for them. They run as the owner of the schema; all others lose the
/// right to them.
std::string GrantScript(const Grants& grants);

}  // namespace contact::postgres
