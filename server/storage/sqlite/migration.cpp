#include "storage/sqlite/migration.h"

#include <absl/strings/str_cat.h>
#include <sqlite3.h>

#include "contact/v1/job.pb.h"
#include "storage/checksum.h"
#include "storage/job_parts.h"
#include "storage/sqlite/row_checksum.h"
#include "storage/sqlite/schema.h"

namespace contact {
namespace {

// From 1: ended jobs know when they ended, all know what they take, and events may be coded.
constexpr char kToVersion2[] = R"sql(
ALTER TABLE jobs ADD COLUMN end_time INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE events ADD COLUMN coding INTEGER NOT NULL DEFAULT 0;
UPDATE jobs SET
  end_time = end_time_of(header),
  bytes = COALESCE((SELECT SUM(LENGTH(payload)) FROM events WHERE job=number), 0)
        + COALESCE((SELECT LENGTH(spec) FROM specs WHERE job=number), 0)
        + COALESCE((SELECT LENGTH(result) FROM results WHERE job=number), 0);
)sql";

// From 2: frame chunks of ended jobs may be dropped, and long runs have checkpoints.
constexpr char kToVersion3[] = R"sql(
ALTER TABLE jobs ADD COLUMN oldest_sequence INTEGER NOT NULL DEFAULT 1;
ALTER TABLE jobs ADD COLUMN compacted INTEGER NOT NULL DEFAULT 0;
)sql";

// From 4: jobs belong to somebody, and request ids to a tenant. All jobs so far are those of
// `local`.
constexpr char kToVersion5[] = R"sql(
ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT 'local';
ALTER TABLE jobs ADD COLUMN tenant TEXT NOT NULL DEFAULT 'local';
CREATE INDEX jobs_by_tenant ON jobs(tenant, number);
UPDATE jobs SET request_id = 'local/' || request_id WHERE request_id IS NOT NULL;
)sql";

// From 5: columns that stand nowhere else have a checksum.
void SealRows(SQLite::Database& connection) {
  connection.exec("ALTER TABLE jobs ADD COLUMN row_crc32 INTEGER NOT NULL DEFAULT 0");
  connection.exec(absl::StrCat("UPDATE jobs SET row_crc32=", kRowChecksum));
}

// From 7: people may say more of a job than when they created it.
constexpr char kToVersion8[] = R"sql(
ALTER TABLE jobs ADD COLUMN labels_crc32 INTEGER NOT NULL DEFAULT -1;
ALTER TABLE jobs ADD COLUMN labels BLOB NOT NULL DEFAULT x'';
ALTER TABLE jobs ADD COLUMN note_crc32 INTEGER NOT NULL DEFAULT -1;
ALTER TABLE jobs ADD COLUMN note BLOB NOT NULL DEFAULT x'';
)sql";

// SQL function: the end of the job with this header in Unix seconds; 0 if it does not tell.
void EndTimeOf(sqlite3_context* context, int, sqlite3_value** arguments) {
  v1::Job job;
  const void* header = sqlite3_value_blob(arguments[0]);
  const bool parsed = job.ParseFromArray(header, sqlite3_value_bytes(arguments[0]));
  sqlite3_result_int64(context, parsed ? job.end_time().seconds() : 0);
}

// The header with the title that its spec tells; empty if that changes nothing, or if one of the
// two cannot be read.
std::string WithTitle(const std::string& header, const std::string& spec) {
  v1::Job job, asked;
  if (!asked.ParseFromString(spec) || TitleOf(asked).empty()) return "";
  if (!job.ParseFromString(header) || job.name().empty()) return "";
  job.set_title(TitleOf(asked));
  return Split(job).header;
}

// From 3: headers have the title of the job. Damaged ones are left as they are, and so found.
void AddTitles(SQLite::Database& connection) {
  SQLite::Statement jobs(
      connection, "SELECT number, jobs.crc32, header, spec FROM jobs JOIN specs ON job=number");
  SQLite::Statement update(connection, "UPDATE jobs SET crc32=?, header=? WHERE number=?");
  while (jobs.executeStep()) {
    const std::string header = jobs.getColumn(2).getString();
    const std::string titled = WithTitle(header, jobs.getColumn(3).getString());
    if (titled.empty() || Checksum(header) != jobs.getColumn(1).getInt64()) continue;
    update.bind(1, Checksum(titled));
    update.bindNoCopy(2, titled.data(), static_cast<int>(titled.size()));
    update.bind(3, jobs.getColumn(0).getInt64());
    update.exec();
    update.reset();
  }
}

}  // namespace

void Migrate(SQLite::Database& connection, int version) {
  SQLite::Transaction transaction(connection);
  if (version < 2) {
    connection.createFunction("end_time_of", 1, true, nullptr, EndTimeOf, nullptr, nullptr,
                              nullptr);
    connection.exec(kToVersion2);
  }
  if (version < 3) {
    connection.exec(kToVersion3);
    connection.exec(kSchemaOfVersion3);
  }
  if (version < 4) AddTitles(connection);
  if (version < 5) connection.exec(kToVersion5);
  if (version < 6) SealRows(connection);
  // From 6: new rows have the name of their job in their checksum. Old ones stay as they are.
  if (version < 8) connection.exec(kToVersion8);
  connection.exec(absl::StrCat("PRAGMA user_version=", kSchemaVersion));
  transaction.commit();
}

}  // namespace contact
