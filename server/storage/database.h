#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

#include "storage/data_directory.h"

namespace contact {

/// The one connection to the database of a data directory. Belongs to one thread at a time.
///
/// SQL errors are thrown as SQLite::Exception.
class Database {
 public:
  /// Opens the database, or makes it in a new directory, and checks it: it must be whole, not
  /// newer than this program, and there if the directory was initialised. An older one is brought
  /// up to date, after a copy of it was put beside it. `max_bytes` limits its size; 0: the disk
  /// does. A database that is refused is left as it was.
  ///
  /// Errors: DATA_LOSS (damaged or gone), FAILED_PRECONDITION (newer; cannot be written).
  static absl::StatusOr<std::unique_ptr<Database>> Open(DataDirectory directory,
                                                        std::int64_t max_bytes);

  /// The statement of an SQL text, prepared once. Use it through Query.
  SQLite::Statement& Prepared(const std::string& sql);
  std::int64_t LastInsertRowid() const { return connection_.getLastInsertRowid(); }
  SQLite::Database& connection() { return connection_; }
  const DataDirectory& directory() const { return directory_; }

  /// Pages in the write-ahead log that are not in the database file yet.
  int log_pages() const { return log_pages_; }
  /// Moves them there.
  void Checkpoint();

 private:
  explicit Database(DataDirectory directory);
  absl::Status Check();
  void KeepOldVersion();
  absl::Status BringUpToDate();
  void Configure(std::int64_t max_bytes);
  std::int64_t Number(const char* sql);

  DataDirectory directory_;
  SQLite::Database connection_;
  std::map<std::string, SQLite::Statement> statements_;  // After connection_: they go first.
  int version_ = 0;                                      // Of the schema; 0: there is none.
  int log_pages_ = 0;
};

/// One use of a prepared statement: binds its parameters in order, and resets it at the end.
class Query {
 public:
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

  std::int64_t Integer(int column) const { return statement_.getColumn(column).getInt64(); }
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

/// What an error means. RESOURCE_EXHAUSTED: no space; DATA_LOSS: damaged; UNAVAILABLE: the disk
/// failed; else INTERNAL.
absl::Status ToStatus(const SQLite::Exception& error);

}  // namespace contact
