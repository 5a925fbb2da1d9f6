#include "storage/sqlite/database.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <pthread.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>

#include "base/mutex.h"
#include "storage/sqlite/database_copy.h"
#include "storage/sqlite/migration.h"
#include "storage/sqlite/row_checksum.h"
#include "storage/sqlite/schema.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

// What is wrong with a database is looked for so long before it is used: SQLite reads every page,
// half a gigabyte in this time if the system has them in memory.
constexpr std::chrono::seconds kLookTime{1};

// Decides whether a database may be made where there is none.
absl::Status CheckPresence(const DataDirectory& directory) {
  std::error_code missing;
  const auto size = fs::file_size(directory.database(), missing);
  if (!directory.initialised() || (!missing && size > 0)) return absl::OkStatus();
  return absl::DataLossError(absl::StrCat(
      directory.database().string(), missing ? " is missing" : " is empty",
      " though its directory was in use; restore it from a backup, or remove the directory to "
      "begin anew"));
}

absl::Status CheckAccess(const DataDirectory& directory) {
  const fs::path file = directory.database();
  if (fs::is_symlink(file)) {
    return absl::FailedPreconditionError(absl::StrCat(
        file.string(), " is a link; put the database there, or name its directory by --data-dir"));
  }
  if (!fs::exists(file) || ::faccessat(AT_FDCWD, file.c_str(), R_OK | W_OK, AT_EACCESS) == 0) {
    return absl::OkStatus();
  }
  return absl::FailedPreconditionError(absl::StrCat(
      "cannot use ", file.string(), ": ", std::generic_category().message(errno), kGiveAccess));
}

absl::Status Damaged(const std::string& file, const std::string& what) {
  return absl::DataLossError(absl::StrCat(file, " is damaged (", what,
                                          "); restore it from a backup, or move its directory "
                                          "away to begin anew"));
}

void Defend(sqlite3* connection) {
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  // Closing a connection writes; a database that is refused must stay as it was.
  sqlite3_db_config(connection, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

}  // namespace

absl::StatusOr<std::unique_ptr<Database>> Database::Open(DataDirectory directory,
                                                         std::int64_t max_bytes,
                                                         std::int64_t reserve_bytes) {
  if (absl::Status present = CheckPresence(directory); !present.ok()) return present;
  if (absl::Status access = CheckAccess(directory); !access.ok()) return access;
  const std::string file = directory.database().string();
  try {
    std::unique_ptr<Database> database(new Database(std::move(directory)));
    if (absl::Status good = database->Check(); !good.ok()) return good;
    database->KeepOldVersion();
    database->Configure(max_bytes);
    if (absl::Status made = database->BringUpToDate(); !made.ok()) return made;
    database->connection_.exec(kOwnerBytes);
    database->reserve_.emplace(database->directory().reserve(), reserve_bytes);
    return database;
  } catch (const SQLite::Exception& error) {
    if (absl::IsDataLoss(ToStatus(error))) return Damaged(file, error.what());
    return absl::FailedPreconditionError(absl::StrCat("cannot open ", file, ": ", error.what()));
  }
}

Database::Database(DataDirectory directory)
    : directory_(std::move(directory)),
      connection_(directory_.database(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
  Defend(connection_.getHandle());
}

absl::Status Database::Check() {
  const std::string file = directory_.database().string();
  connection_.exec("PRAGMA locking_mode=EXCLUSIVE; PRAGMA cell_size_check=ON");
  version_ = static_cast<int>(Number("PRAGMA user_version"));
  if (version_ > kSchemaVersion) {
    return absl::FailedPreconditionError(absl::StrCat(file, " has schema version ", version_,
                                                      ", this program knows ", kSchemaVersion,
                                                      "; start the newer program that made it"));
  }
  const std::string verdict = Look();
  if (verdict != "ok") return Damaged(file, verdict);
  if (version_ == 0 && directory_.initialised()) return Damaged(file, "it has no schema");
  return absl::OkStatus();
}

std::string Database::Look() {
  Mutex mutex;
  std::condition_variable_any ended;
  const std::jthread alarm([&, handle = connection_.getHandle()](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "look");
    const MutexLock lock(mutex);
    ended.wait_for(mutex, stop, kLookTime, [] { return false; });
    if (!stop.stop_requested()) sqlite3_interrupt(handle);
  });
  try {
    return connection_.execAndGet("PRAGMA quick_check(1)").getString();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() != SQLITE_INTERRUPT) throw;
    return "ok";
  }
}

void Database::Configure(std::int64_t max_bytes) {
  connection_.exec(
      "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA wal_autocheckpoint=0;"
      "PRAGMA mmap_size=0; PRAGMA foreign_keys=ON; PRAGMA trusted_schema=OFF;"
      "PRAGMA secure_delete=OFF");
  if (max_bytes > 0) {
    const std::int64_t pages = max_bytes / Number("PRAGMA page_size");
    connection_.exec(absl::StrCat("PRAGMA max_page_count=", pages));
  }
  AddRowChecksum(connection_);
  sqlite3* const handle = connection_.getHandle();
  sqlite3_db_config(handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
  sqlite3_wal_hook(
      handle,
      [](void* log_pages, sqlite3*, const char*, int pages) {
        *static_cast<int*>(log_pages) = pages;
        return SQLITE_OK;
      },
      &log_pages_);
}

// Puts a copy beside a database that is about to be migrated.
void Database::KeepOldVersion() {
  if (version_ == 0 || version_ == kSchemaVersion) return;
  CopyDatabase(connection_, absl::StrCat(directory_.database().string(), ".v", version_));
}

absl::Status Database::BringUpToDate() {
  if (version_ == 0) {
    SQLite::Transaction transaction(connection_);
    connection_.exec(kSchema);
    connection_.exec(kSchemaOfVersion3);
    connection_.exec(absl::StrCat("PRAGMA user_version=", kSchemaVersion));
    transaction.commit();
    Checkpoint();
  } else if (version_ < kSchemaVersion) {
    Migrate(connection_, version_);
    Checkpoint();
  }
  return directory_.initialised() ? absl::OkStatus() : directory_.MarkInitialised();
}

std::int64_t Database::Number(const char* sql) { return connection_.execAndGet(sql).getInt64(); }

SQLite::Statement& Database::Prepared(const std::string& sql) {
  const auto found = statements_.find(sql);
  if (found != statements_.end()) return found->second;
  return statements_.emplace(sql, SQLite::Statement(connection_, sql)).first->second;
}

void Database::Checkpoint() {
  const int result = sqlite3_wal_checkpoint_v2(connection_.getHandle(), nullptr,
                                               SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr);
  if (result != SQLITE_OK) throw SQLite::Exception(connection_.getHandle(), result);
  log_pages_ = 0;
}

absl::Status ToStatus(const SQLite::Exception& error) {
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
    case SQLITE_NOMEM:
      return absl::ResourceExhaustedError(absl::StrCat("the store is full: ", error.what()));
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return absl::DataLossError(absl::StrCat("the store is damaged: ", error.what()));
    case SQLITE_IOERR:
      // A quota or a limit on the size of files, as a rule. Nothing was promised and nothing is
      // half done, unlike after a failed sync.
      if (error.getExtendedErrorCode() == SQLITE_IOERR_WRITE) {
        return absl::ResourceExhaustedError("the store cannot write");
      }
      [[fallthrough]];
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
      return absl::UnavailableError(absl::StrCat("the disk of the store failed: ", error.what()));
    default:
      return absl::InternalError(absl::StrCat("the store failed: ", error.what()));
  }
}

}  // namespace contact
