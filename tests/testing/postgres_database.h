#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

#include "base/ids.h"
#include "storage/postgres/connection.h"

namespace contact {

/// A new database of the server that ctest starts for these tests (postgres.py), removed at the end
/// of the scope.
class PostgresDatabase {
 public:
  PostgresDatabase() { Run(AddressOf("postgres"), {"CREATE DATABASE " + name_}); }
  ~PostgresDatabase() { Run(AddressOf("postgres"), {"DROP DATABASE " + name_ + " WITH (FORCE)"}); }
  PostgresDatabase(const PostgresDatabase&) = delete;
  PostgresDatabase& operator=(const PostgresDatabase&) = delete;

  std::string address() const { return AddressOf(name_); }

  /// What one statement answers.
  postgres::Rows Run(const std::string& sql) const { return Run(address(), {sql}); }

 private:
  static std::string AddressOf(const std::string& database) {
    std::ifstream file(CONTACT_POSTGRES_FILE);
    std::string folder;
    if (!(file >> folder)) throw std::runtime_error("no PostgreSQL: run these tests by ctest");
    return "postgresql://contactd@/" + database + "?host=" + folder;
  }
  static postgres::Rows Run(const std::string& address, const postgres::Statement& statement) {
    const auto connection = postgres::Connection::Open(address);
    if (!connection.ok()) throw std::runtime_error(connection.status().ToString());
    absl::StatusOr<postgres::Rows> rows = (*connection)->Run(statement);
    if (!rows.ok()) throw std::runtime_error(rows.status().ToString());
    return *std::move(rows);
  }

  const std::string name_ = "test_" + RandomIds().NextId();
};

}  // namespace contact
