#include "storage/postgres/migration.h"

#include <absl/strings/str_cat.h>

#include <array>
#include <string>

#include "storage/postgres/schema.h"

namespace contact::postgres {
namespace {

// Changes the tables of the version before `version` to those of this one.
struct Step {
  int version;
  const char* sql;
};

// A version that changes functions alone needs none.
constexpr std::array kSteps = {
    // Nothing looks for all unfinished jobs by an index any more; jobs are taken by their worker.
    Step{2,
         "DROP INDEX IF EXISTS contactd.jobs_unfinished, contactd.jobs_taken;"
         "CREATE INDEX jobs_taken ON contactd.jobs(worker, number)"
         " WHERE state = 2 OR (state = 1 AND worker IS NOT NULL);"},
    // Processes share the secret of page tokens, and heads of audit logs.
    Step{5,
         "CREATE TABLE IF NOT EXISTS contactd.kept(name text COLLATE \"C\" PRIMARY KEY, value "
         "bytea NOT NULL);"},
    // People may say more of a job than when they created it.
    Step{6,
         "ALTER TABLE contactd.jobs"
         " ADD COLUMN IF NOT EXISTS labels_crc32 bigint NOT NULL DEFAULT -1,"
         " ADD COLUMN IF NOT EXISTS labels bytea NOT NULL DEFAULT '',"
         " ADD COLUMN IF NOT EXISTS note_crc32 bigint NOT NULL DEFAULT -1,"
         " ADD COLUMN IF NOT EXISTS note bytea NOT NULL DEFAULT '';"},
};

// The lock is held to the end, so that of several programs that begin at once one does it. Tables
// may be large, and the others wait for as long.
constexpr char kBegin[] =
    "BEGIN; SET LOCAL statement_timeout = 0; SELECT pg_advisory_xact_lock(1668247156)";  // "cont".

// Functions hold no data, so each version makes its own anew. They are the owner's until others are
// given them.
constexpr char kDropFunctions[] = R"sql(
DO $$
DECLARE
  v_routine regprocedure;
BEGIN
  FOR v_routine IN SELECT p.oid FROM pg_proc p WHERE p.pronamespace = 'contactd'::regnamespace
  LOOP
    EXECUTE 'DROP ROUTINE ' || v_routine;
  END LOOP;
END $$;
)sql";
constexpr char kKeepFunctions[] = "REVOKE ALL ON ALL FUNCTIONS IN SCHEMA contactd FROM PUBLIC;";

absl::Status Refusal(const Connection& connection, const std::string& why) {
  return absl::FailedPreconditionError(absl::StrCat(connection.Name(), " ", why));
}

// Whether there are tables, and whether they have a function that tells their version. From the
// catalog: what a session has once looked up by name it may still believe while it has a lock.
constexpr char kFind[] = R"sql(
SELECT
  EXISTS(SELECT FROM pg_tables WHERE schemaname = 'contactd' AND tablename = 'version'),
  EXISTS(SELECT FROM pg_proc p JOIN pg_namespace n ON n.oid = p.pronamespace
    WHERE n.nspname = 'contactd' AND p.proname = 'schema_version')
)sql";

// The version of the tables; 0: there are none.
absl::StatusOr<int> Version(Connection& connection) {
  const auto found = connection.Run({kFind});
  if (!found.ok()) return found.status();
  if (found->Integer(0, 0) == 0) return 0;
  // Version 1 has no such function.
  const auto version =
      connection.Run({found->Integer(0, 1) != 0 ? "SELECT contactd.schema_version()"
                                                : "SELECT max(version) FROM contactd.version"});
  if (!version.ok()) return version.status();
  return static_cast<int>(version->Integer(0, 0));  // 0 for NULL: the table is empty.
}

// The version of the tables, which is no newer than this program's.
absl::StatusOr<int> KnownVersion(Connection& connection) {
  auto version = Version(connection);
  if (absl::IsFailedPrecondition(version.status())) {
    return Refusal(connection,
                   "lets this role call nothing; run contactd migrate as the owner of its tables,"
                   " with --grant-front or --grant-worker");
  }
  if (!version.ok() || *version <= kSchemaVersion) return version;
  return Refusal(connection, absl::StrCat("has schema version ", *version,
                                          ", this program knows versions up to ", kSchemaVersion,
                                          "; start the newer program"));
}

// The statements that make the tables of this program, of nothing or of those of an older version.
std::string Tables(int version) {
  if (version == 0) return kTables;
  std::string script = kDropFunctions;
  for (const Step& step : kSteps) {
    if (step.version > version) absl::StrAppend(&script, step.sql);
  }
  return script;
}

// Brings what is older than this program up to date.
absl::Status Update(Connection& connection, int version) {
  absl::Status made = connection.RunScript(absl::StrCat(
      Tables(version), kFunctions, kReaderFunctions, kWorkerFunctions, kKeepFunctions,
      "DELETE FROM contactd.version; INSERT INTO contactd.version VALUES(", kSchemaVersion, ")"));
  if (!absl::IsFailedPrecondition(made)) return made;
  return Refusal(connection,
                 version == 0
                     ? "has no tables; run contactd migrate as a role that may make them"
                     : "has tables of an older version; run contactd migrate as their owner");
}

// Under the lock: what another program has done meanwhile is seen.
absl::Status Change(Connection& connection, const std::string& grants) {
  const auto version = KnownVersion(connection);
  if (!version.ok()) return version.status();
  if (*version < kSchemaVersion) {
    if (absl::Status updated = Update(connection, *version); !updated.ok()) return updated;
  }
  return grants.empty() ? absl::OkStatus() : connection.RunScript(grants);
}

}  // namespace

absl::Status Migrate(Connection& connection, const Grants& grants) {
  const std::string granted = GrantScript(grants);
  const auto version = KnownVersion(connection);
  if (!version.ok()) return version.status();
  if (*version == kSchemaVersion && granted.empty()) return absl::OkStatus();
  if (absl::Status begun = connection.RunScript(kBegin); !begun.ok()) return begun;
  const absl::Status changed = Change(connection, granted);
  const absl::Status ended = connection.RunScript(changed.ok() ? "COMMIT" : "ROLLBACK");
  return changed.ok() ? ended : changed;
}

}  // namespace contact::postgres
