#include "storage/postgres/migration.h"

#include <absl/strings/str_cat.h>

#include "storage/postgres/schema.h"

namespace contact::postgres {
namespace {

// Held while the tables are changed, so that of several programs that begin at once one does it.
constexpr char kLock[] = "SELECT pg_advisory_xact_lock(1668247156);";  // "cont".

// The version of the tables; 0: there are none.
absl::StatusOr<int> Version(Connection& connection) {
  const auto table = connection.Run({"SELECT to_regclass('contactd.version') IS NOT NULL"});
  if (!table.ok()) return table.status();
  if (table->Integer(0, 0) == 0) return 0;
  const auto version = connection.Run({"SELECT contactd.schema_version()"});
  if (!version.ok()) return version.status();
  return static_cast<int>(version->Integer(0, 0));  // 0 for NULL: the table is empty.
}

absl::Status IsNewer(const Connection& connection, int version) {
  return absl::FailedPreconditionError(absl::StrCat(connection.Name(), " has schema version ",
                                                    version, ", this program knows versions up to ",
                                                    kSchemaVersion, "; start the newer program"));
}

}  // namespace

absl::Status Migrate(Connection& connection) {
  const auto version = Version(connection);
  if (!version.ok()) return version.status();
  if (*version > kSchemaVersion) return IsNewer(connection, *version);
  if (*version == kSchemaVersion) return absl::OkStatus();
  const absl::Status made = connection.RunScript(
      absl::StrCat(kLock, kTables, kFunctions, kReaderFunctions, kWorkerFunctions,
                   "INSERT INTO contactd.version VALUES(", kSchemaVersion, ")"));
  // Another program may have done it meanwhile.
  return CheckVersion(connection).ok() ? absl::OkStatus() : made;
}

absl::Status CheckVersion(Connection& connection) {
  const auto version = Version(connection);
  if (!version.ok()) return version.status();
  if (*version == kSchemaVersion) return absl::OkStatus();
  if (*version > kSchemaVersion) return IsNewer(connection, *version);
  return absl::FailedPreconditionError(absl::StrCat(
      connection.Name(), *version == 0 ? " has no tables" : " has tables of an older version",
      "; run contactd migrate"));
}

}  // namespace contact::postgres
