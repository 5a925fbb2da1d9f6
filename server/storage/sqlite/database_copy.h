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
  /// Begins to copy `from`, which must outlive this, into the file `to`. Replaces a file that is
  /// there.
  DatabaseCopy(SQLite::Database& from, const std::filesystem::path& to);

  /// Copies about 1 MiB. Returns false once the copy is complete; the file is then closed, but not
  /// synchronised.
  bool Step();

 private:
  std::optional<SQLite::Database> to_;
  // After to_, because it must go before it.
  std::optional<SQLite::Backup> backup_;
};

/// Copies a database as a whole into the file `to`. The file appears complete and synchronised, or
/// not at all. Errors are thrown as SQLite::Exception.
void CopyDatabase(SQLite::Database& from, const std::filesystem::path& to);

}  // namespace contact
