#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "base/reserve.h"
#include "storage/sqlite/data_directory.h"

namespace contact {

/// The one connection to the database of a data directory. Belongs to one thread at a time.
///
/// SQL errors are thrown as SQLite::Exception.
class Database {
 public:
  /// Opens the database, or makes it in a new directory, and checks it: it must be whole, not
  /// newer than this program, and there if the directory was initialised. An older one is brought
  /// up to date, after a copy of it was put beside it. `max_bytes` limits its size; 0: the disk
  /// does. `reserve_bytes`: see Reserve. A database that is refused is left as it was.
  ///
  /// Errors: DATA_LOSS (damaged or gone), FAILED_PRECONDITION (newer; cannot be written).
  static absl::StatusOr<std::unique_ptr<Database>> Open(DataDirectory directory,
                                                        std::int64_t max_bytes,
                                                        std::int64_t reserve_bytes = 0);

  /// The statement of an SQL text, prepared once. Use it through Query.
  SQLite::Statement& Prepared(const std::string& sql);
  /// The key of the row inserted last, such as the number of a new job.
  std::int64_t LastInsertRowid() const { return connection_.getLastInsertRowid(); }
  /// For transactions and copies.
  SQLite::Database& connection() { return connection_; }
  const DataDirectory& directory() const { return directory_; }
  /// Space for operations that free some.
  Reserve& reserve() { return *reserve_; }

  /// Pages in the write-ahead log that are not in the database file yet.
  int log_pages() const { return log_pages_; }
  /// Copies the pages of the write-ahead log into the database file.
  void Checkpoint();

 private:
  explicit Database(DataDirectory directory);
  // Fills `version_`. DATA_LOSS: damaged; FAILED_PRECONDITION: newer than this program.
  absl::Status Check();
  // What SQLite finds wrong, or "ok". A large database is looked at in part.
  std::string Look();
  // Puts a copy beside a database that is about to be migrated.
  void KeepOldVersion();
  // Makes the tables, or brings those of an older version up to date, and marks the directory.
  absl::Status BringUpToDate();
  // Sets how SQLite commits and what it allows.
  void Configure(std::int64_t max_bytes);
  // The one number that a query gives.
  std::int64_t Number(const char* sql);

  DataDirectory directory_;
  SQLite::Database connection_;
  // By SQL text. After connection_, because they must go before it.
  std::map<std::string, SQLite::Statement> statements_;
  // Schema version of the database that was found; 0: it had no tables.
  int version_ = 0;
  // Updated by a hook of SQLite at each commit.
  int log_pages_ = 0;
  // Set once the database is open.
  std::optional<Reserve> reserve_;
};

/// One use of a prepared statement: binds its parameters in order, and resets it at the end. Two
/// uses of one SQL text must not overlap. Columns are counted from 0.
class Query {
 public:
  /// Binds `values` to the first parameters of the statement.
  template <class... Values>
  Query(Database& database, const std::string& sql, const Values&... values)
      : statement_(database.Prepared(sql)) {
    (Bind(values), ...);
  }
  ~Query() {
    statement_.tryReset();
    statement_.clearBindings();
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  /// Runs to the next row; false after the last.
  bool Next() { return statement_.executeStep(); }
  /// Runs a statement without rows and returns the number of rows changed.
  int Run() { return statement_.exec(); }

  /// An integer of the present row; 0 for NULL.
  std::int64_t Integer(int column) const { return statement_.getColumn(column).getInt64(); }
  /// A text or blob of the present row; empty for NULL.
  std::string Bytes(int column) const { return statement_.getColumn(column).getString(); }

  /// Bytes to store as they are; they must outlive the query.
  struct Blob {
    const std::string& bytes;
  };

  /// Binds the next parameter.
  template <class Value>
  requires std::is_integral_v<Value> || std::is_enum_v<Value>
  void Bind(Value value) { statement_.bind(++bound_, static_cast<std::int64_t>(value)); }
  void Bind(const std::string& text) { statement_.bind(++bound_, text); }
  void Bind(Blob blob) {
    statement_.bindNoCopy(++bound_, blob.bytes.data(), static_cast<int>(blob.bytes.size()));
  }

 private:
  SQLite::Statement& statement_;
  int bound_ = 0;
};

/// Runs a statement without rows, with these values for its parameters.
template <class... Values>
void Execute(Database& database, const std::string& sql, const Values&... values) {
  Query(database, sql, values...).Run();
}

/// What an error means. RESOURCE_EXHAUSTED: no space; DATA_LOSS: damaged; UNAVAILABLE: the disk
/// failed; else INTERNAL.
absl::Status ToStatus(const SQLite::Exception& error);

}  // namespace contact
