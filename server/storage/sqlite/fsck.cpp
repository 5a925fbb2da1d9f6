#include "storage/sqlite/fsck.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <sqlite3.h>

#include <map>
#include <memory>
#include <system_error>
#include <utility>

#include "contact/v1/job.pb.h"
#include "storage/checksum.h"
#include "storage/job_parts.h"
#include "storage/rows.h"
#include "storage/sqlite/data_directory.h"
#include "storage/sqlite/row_checksum.h"
#include "storage/sqlite/schema.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

using Connection = std::unique_ptr<SQLite::Database>;

// Without a log the file is read as it is, also from a medium that cannot be written. With one,
// SQLite reads both and must think that it may write; it is kept from doing so.
Connection Connect(const fs::path& file) {
  std::error_code missing;
  const auto log_bytes = fs::file_size(file.string() + "-wal", missing);
  if (missing || log_bytes == 0) {
    const std::string escaped =
        absl::StrReplaceAll(file.string(), {{"%", "%25"}, {"?", "%3f"}, {"#", "%23"}});
    return std::make_unique<SQLite::Database>(absl::StrCat("file:", escaped, "?immutable=1"),
                                              SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  }
  auto connection = std::make_unique<SQLite::Database>(file, SQLite::OPEN_READWRITE);
  sqlite3_db_config(connection->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  connection->exec("PRAGMA locking_mode=EXCLUSIVE; PRAGMA query_only=ON");
  return connection;
}

absl::StatusOr<Connection> OpenToCheck(const fs::path& file) {
  std::error_code missing;
  const auto size = fs::file_size(file, missing);
  if (missing) return absl::NotFoundError(absl::StrCat("there is no ", file.string()));
  if (size == 0) return absl::DataLossError(absl::StrCat(file.string(), " is empty"));
  try {
    Connection connection = Connect(file);
    const int version = connection->execAndGet("PRAGMA user_version").getInt();
    if (version == kSchemaVersion) return connection;
    return absl::FailedPreconditionError(absl::StrCat(
        file.string(), " has schema version ", version, ", this program checks ", kSchemaVersion,
        version < kSchemaVersion ? "; start contactd on it once to bring it up to date"
                                 : "; use the program that made it"));
  } catch (const SQLite::Exception& error) {
    return absl::DataLossError(absl::StrCat("cannot read ", file.string(), ": ", error.what()));
  }
}

// A row that a query found.
class Row {
 public:
  explicit Row(SQLite::Statement& query) : query_(query) {}

  std::int64_t Integer(int column) const { return query_.getColumn(column).getInt64(); }
  std::string Bytes(int column) const { return query_.getColumn(column).getString(); }

 private:
  SQLite::Statement& query_;
};

class Checker {
 public:
  Checker(SQLite::Database& connection, const std::function<void(const std::string&)>& tell)
      : connection_(connection), tell_(tell) {}

  FsckReport Run() {
    AddRowChecksum(connection_);
    Check("database", "PRAGMA integrity_check(100)", &Checker::CheckPage);
    Check("database", "PRAGMA foreign_key_check", &Checker::CheckReference);
    Check("jobs",
          absl::StrCat("SELECT number, name, state, last_sequence, bytes, crc32, header,"
                       " oldest_sequence, owner, tenant, end_time, row_crc32=",
                       kRowChecksum,
                       ", labels_crc32, labels, note_crc32, note FROM jobs ORDER BY number"),
          &Checker::CheckJob);
    Check("labels", "SELECT job, key, value FROM labels", &Checker::KeepLabel);
    Check("specs", "SELECT job, crc32, spec FROM specs", &Checker::CheckSpec);
    Check("results", "SELECT job, crc32, result FROM results", &Checker::CheckResult);
    Check("events",
          "SELECT job, sequence, kind, coding, crc32, payload FROM events"
          " WHERE job NOT IN (SELECT job FROM removed) ORDER BY job, sequence",
          &Checker::CheckEvent);
    Check("checkpoints", "SELECT job, crc32, state FROM checkpoints", &Checker::CheckCheckpoint);
    CheckTotals();
    return report_;
  }

 private:
  // What a job says of itself, and what was found.
  struct Job {
    std::string name;
    std::int64_t oldest_sequence = 1;
    std::int64_t last_sequence = 0;
    std::int64_t bytes = 0;
    JobLabels labels;                   // Those by which it is found.
    std::optional<JobLabels> remarked;  // Those of a remark.
    std::string title;
    bool has_spec = false;
    std::int64_t found_sequence = 0;
    std::int64_t found_bytes = 0;
  };

  template <class... Words>
  void Find(const Words&... words) {
    ++report_.findings;
    tell_(absl::StrCat(words...));
  }

  // Checks every row of a query. A page that cannot be read ends this part of the check, not all
  // of it.
  void Check(const char* part, const std::string& sql, void (Checker::*check)(Row)) {
    try {
      SQLite::Statement query(connection_, sql);
      while (query.executeStep()) (this->*check)(Row(query));
    } catch (const SQLite::Exception& error) {
      Find(part, ": cannot be read to the end: ", error.what());
    }
  }

  void CheckPage(Row row) {
    if (const std::string verdict = row.Bytes(0); verdict != "ok") Find("database: ", verdict);
  }

  void CheckReference(Row row) { Find("database: a row of ", row.Bytes(0), " belongs to no job"); }

  void CheckJob(Row row) {
    ++report_.jobs;
    Job& job = jobs_[row.Integer(0)];
    job.name = row.Bytes(1);
    job.last_sequence = row.Integer(3);
    job.bytes = row.Integer(4);
    job.oldest_sequence = row.Integer(7);
    const std::string header = row.Bytes(6);
    v1::Job message;
    if (Checksum(header) != row.Integer(5) || row.Integer(11) == 0) {
      Find(job.name, ": the job fails its checksum");
    } else if (!message.ParseFromString(header) || message.name() != job.name ||
               message.state() != row.Integer(2) || OwnerOf(message) != row.Bytes(8) ||
               TenantOf(message) != row.Bytes(9) ||
               message.end_time().seconds() != row.Integer(10)) {
      Find(job.name, ": the job is not what its row says");
    }
    job.title = message.title();
    if (row.Integer(12) != kNoRemark) CheckLabels(row.Integer(12), row.Bytes(13), &job);
    if (row.Integer(14) != kNoRemark && !Passes(row.Integer(14), row.Bytes(15), job.name)) {
      Find(job.name, ": its note fails its checksum");
    }
  }

  void CheckLabels(std::int64_t crc32, const std::string& bytes, Job* job) {
    v1::Job said;
    if (!Passes(crc32, bytes, job->name) || !said.ParseFromString(bytes)) {
      return Find(job->name, ": its labels fail their checksum");
    }
    job->remarked.emplace(said.labels().begin(), said.labels().end());
  }

  void KeepLabel(Row row) {
    const auto job = jobs_.find(row.Integer(0));
    if (job != jobs_.end()) job->second.labels[row.Bytes(1)] = row.Bytes(2);
  }

  void CheckSpec(Row row) {
    v1::Job spec;
    Job* job = CheckPart("spec", row, &spec);
    if (job == nullptr) return;
    const JobLabels created(spec.labels().begin(), spec.labels().end());
    if (job->remarked.value_or(created) != job->labels) {
      Find(job->name, ": its labels are not those that it was given");
    }
    if (TitleOf(spec) != job->title) Find(job->name, ": its spec is that of another job");
  }

  void CheckResult(Row row) {
    v1::Job result;
    CheckPart("result", row, &result);
  }

  // Reads what a row has of a job into `message`. Returns the job; null if the part cannot be used.
  Job* CheckPart(const std::string& part, Row row, v1::Job* message) {
    const auto job = jobs_.find(row.Integer(0));
    if (job == jobs_.end()) return nullptr;  // CheckReference has told.
    const std::string bytes = row.Bytes(2);
    job->second.found_bytes += static_cast<std::int64_t>(bytes.size());
    job->second.has_spec |= part == "spec";
    if (!Passes(row.Integer(1), bytes, job->second.name)) {
      Find(job->second.name, ": its ", part, " fails its checksum");
    } else if (!message->ParseFromString(bytes)) {
      Find(job->second.name, ": its ", part, " is no message");
    } else {
      return &job->second;
    }
    return nullptr;
  }

  void CheckEvent(Row row) {
    ++report_.events;
    const auto found = jobs_.find(row.Integer(0));
    if (found == jobs_.end()) return Find("database: an event belongs to no job");
    Job& job = found->second;
    const std::int64_t sequence = row.Integer(1);
    const CodedEvent coded{static_cast<Coding>(row.Integer(3)), row.Bytes(5)};
    if (sequence != job.found_sequence + 1 && sequence > job.oldest_sequence) {
      Find(job.name, ": events ", job.found_sequence + 1, " to ", sequence - 1, " are missing");
    }
    job.found_sequence = sequence;
    job.found_bytes += static_cast<std::int64_t>(coded.bytes.size());
    v1::Event event;
    if (!Passes(row.Integer(4), coded, static_cast<std::uint64_t>(sequence), job.name)) {
      Find(job.name, ": event ", sequence, " fails its checksum");
    } else if (!DecodeEvent(coded.coding, coded.bytes, &event) ||
               event.payload_case() != row.Integer(2)) {
      Find(job.name, ": event ", sequence, " is not what its row says");
    }
  }

  void CheckCheckpoint(Row row) {
    const auto job = jobs_.find(row.Integer(0));
    if (job == jobs_.end()) return;  // CheckReference has told.
    if (!Passes(row.Integer(1), row.Bytes(2), job->second.name)) {
      Find(job->second.name, ": its checkpoint fails its checksum");
    }
  }

  void CheckTotals() {
    for (const auto& [number, job] : jobs_) {
      if (!job.has_spec) Find(job.name, ": its spec is missing");
      if (job.found_sequence != job.last_sequence) {
        Find(job.name, ": its last event is ", job.found_sequence, ", its row says ",
             job.last_sequence);
      } else if (job.found_bytes != job.bytes) {
        Find(job.name, ": takes ", job.found_bytes, " bytes, its row says ", job.bytes);
      }
    }
  }

  SQLite::Database& connection_;
  const std::function<void(const std::string&)>& tell_;
  std::map<std::int64_t, Job> jobs_;  // By number.
  FsckReport report_;
};

}  // namespace

absl::StatusOr<FsckReport> Fsck(const fs::path& directory,
                                const std::function<void(const std::string&)>& tell) {
  const absl::StatusOr<DataDirectory> locked = DataDirectory::OpenToRead(directory);
  if (!locked.ok()) return locked.status();
  const absl::StatusOr<Connection> connection = OpenToCheck(locked->database());
  if (!connection.ok()) return connection.status();
  return Checker(**connection, tell).Run();
}

}  // namespace contact
