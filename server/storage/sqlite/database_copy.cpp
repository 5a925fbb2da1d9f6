#include "storage/sqlite/database_copy.h"

#include <absl/strings/str_cat.h>
#include <sqlite3.h>

#include <system_error>

#include "base/replace_file.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

// Bounds how long one step holds up the commits: 1 MiB.
constexpr int kPagesAStep = 256;

}  // namespace

DatabaseCopy::DatabaseCopy(SQLite::Database& from, const fs::path& to) {
  std::error_code missing;
  fs::remove(to, missing);
  to_.emplace(to, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  // A copy that is not finished is worth nothing, so nothing of it is kept safe on the way.
  to_->exec("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF");
  backup_.emplace(*to_, from);
}

bool DatabaseCopy::Step() {
  if (backup_->executeStep(kPagesAStep) != SQLITE_DONE) return true;
  backup_.reset();
  to_.reset();
  return false;
}

void CopyDatabase(SQLite::Database& from, const fs::path& to) {
  const fs::path draft = to.string() + ".new";
  for (DatabaseCopy copy(from, draft); copy.Step();) {
  }
  if (MoveIntoPlace(draft, to)) {
    throw SQLite::Exception(absl::StrCat("cannot write ", to.string()), SQLITE_IOERR);
  }
}

}  // namespace contact
