#pragma once

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <optional>

namespace contact {

/// Copies a database into a new file, some pages at a time, outside of transactions. What its
/// connection changes meanwhile is carried over, so that the copy is the database as it is at the
/// last step. SQL errors, also of the copy, are thrown as SQLite::Exception.
class DatabaseCopy {
 public:
  /// Replaces a file that is there.
  DatabaseCopy(SQLite::Database& from, const std::filesystem::path& to);

  /// Copies about 1 MiB. False: it is done, and the file is closed but not synchronised.
  bool Step();

 private:
  std::optional<SQLite::Database> to_;
  std::optional<SQLite::Backup> backup_;  // After to_: it goes first.
};

/// Copies a database as a whole; the file is on disk, or there is none.
void CopyDatabase(SQLite::Database& from, const std::filesystem::path& to);

}  // namespace contact
