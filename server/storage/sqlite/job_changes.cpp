#include "storage/sqlite/job_changes.h"

#include <absl/strings/str_cat.h>

#include <utility>

#include "storage/checksum.h"
#include "storage/refusals.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite/job_queries.h"
#include "storage/sqlite/row_checksum.h"
#include "storage/sqlite/schema.h"

namespace contact {
namespace {

// To be called after a change of a column that kRowChecksum names.
void Seal(Database& database, std::int64_t job) {
  Execute(database, absl::StrCat("UPDATE jobs SET row_crc32=", kRowChecksum, " WHERE number=?"),
          job);
}

void InsertEvents(Database& database, std::int64_t job, std::uint64_t last,
                  const std::vector<EventRow>& events, const std::string& name) {
  for (const EventRow& row : events) {
    ++last;
    Execute(database,
            "INSERT INTO events(job, sequence, kind, coding, crc32, payload) VALUES(?,?,?,?,?,?)",
            job, last, row.kind, row.event.coding, Checksum(row.event, last, name),
            Query::Blob{row.event.bytes});
  }
}

void WriteCheckpoint(Database& database, std::int64_t job, std::uint64_t last,
                     const Checkpoint& checkpoint, const std::string& name) {
  Execute(database, "REPLACE INTO checkpoints(job, sequence, crc32, state) VALUES(?,?,?,?)", job,
          last + checkpoint.events, Checksum(checkpoint.state, 0, name),
          Query::Blob{checkpoint.state});
}

// Replaces what is stored of a job beside its log.
void WriteParts(Database& database, std::int64_t job, const JobChange& change) {
  const JobParts& parts = change.parts;
  Execute(database, "UPDATE jobs SET state=?, end_time=?, crc32=?, header=? WHERE number=?",
          change.state, parts.end_time, Checksum(parts.header), Query::Blob{parts.header}, job);
  if (parts.end_time > 0) Execute(database, "DELETE FROM checkpoints WHERE job=?", job);
  if (parts.result.empty()) return;
  Execute(database,
          "UPDATE jobs SET bytes=bytes+?2-"
          "COALESCE((SELECT LENGTH(result) FROM results WHERE job=?1), 0) WHERE number=?1",
          job, parts.result.size());
  Execute(database, "REPLACE INTO results(job, crc32, result) VALUES(?,?,?)", job,
          Checksum(parts.result, 0, change.name), Query::Blob{parts.result});
}

void InsertLabels(Database& database, std::int64_t job, const JobLabels& labels) {
  for (const auto& [key, value] : labels) {
    Execute(database, "INSERT INTO labels(key, value, job) VALUES(?,?,?)", key, value, job);
  }
}

void ReplaceLabels(Database& database, std::int64_t job, const JobRemark& remark) {
  const std::string bytes = BytesOf(*remark.labels);
  Execute(database, "UPDATE jobs SET labels_crc32=?, labels=? WHERE number=?",
          Checksum(bytes, 0, remark.name), Query::Blob{bytes}, job);
  Execute(database, "DELETE FROM labels WHERE job=?", job);
  InsertLabels(database, job, *remark.labels);
}

void InsertJob(Database& database, const JobInsert& insert) {
  const JobParts& parts = insert.parts;
  Execute(database,
          "INSERT INTO jobs(name, request_id, owner, tenant, state, epoch, last_sequence, end_time,"
          " bytes, crc32, header) VALUES(?, NULLIF(?, ''), ?, ?, ?, 0, ?, ?, ?, ?, ?)",
          insert.name, insert.request_key, insert.whose.owner, insert.whose.tenant, insert.state,
          insert.events.size(), parts.end_time, parts.spec.size() + BytesOf(insert.events),
          Checksum(parts.header), Query::Blob{parts.header});
  const std::int64_t job = database.LastInsertRowid();
  Execute(database, "INSERT INTO specs(job, crc32, spec) VALUES(?,?,?)", job,
          Checksum(parts.spec, 0, insert.name), Query::Blob{parts.spec});
  InsertLabels(database, job, insert.labels);
  Seal(database, job);
  InsertEvents(database, job, 0, insert.events, insert.name);
}

// RESOURCE_EXHAUSTED if the owner's jobs take as much as they may.
absl::Status CheckOwnerBytes(Database& database, const JobInsert& insert) {
  if (insert.max_owner_bytes == 0) return absl::OkStatus();
  const std::int64_t bytes = OwnerBytes(database, insert.whose);
  if (bytes < insert.max_owner_bytes) return absl::OkStatus();
  return TooMuch(kOwnerBytesPayload, bytes);
}

// Whether the job has this uid, if that is not empty.
absl::Status CheckUid(Database& database, const std::string& name, const std::string& uid) {
  if (uid.empty()) return absl::OkStatus();
  const absl::StatusOr<StoredJob> stored = Read(database, name, JobPart::kHeader);
  if (!stored.ok()) return stored.status();
  return stored->job.uid() == uid ? absl::OkStatus() : OtherJob(stored->job);
}

// A job that has ended.
struct EndedRow {
  std::int64_t number;
  JobOwner whose;
};

// The row of the job, if it has ended.
absl::StatusOr<EndedRow> FindEnded(Database& database, const std::string& name) {
  Query job(database,
            absl::StrCat("SELECT number, owner, tenant, ", kEnded, " FROM jobs WHERE name=?"),
            name);
  if (!job.Next()) return NoSuchJob(name);
  if (job.Integer(3) != 0) return EndedRow{job.Integer(0), {job.Bytes(1), job.Bytes(2)}};
  return HasNotEnded(name);
}

}  // namespace

absl::StatusOr<StoredJob> Insert(Database& database, const JobInsert& insert) {
  Query made(database,
             "SELECT name, spec FROM jobs LEFT JOIN specs ON job=number WHERE request_id=?",
             insert.request_key);
  if (made.Next()) {
    const std::string name = made.Bytes(0);
    if (made.Bytes(1) == insert.parts.spec) return Read(database, name, JobPart::kAll);
    return RequestIdWasUsed(name);
  }
  if (!insert.may_create) return MayNotBeNew();
  if (absl::Status room = CheckOwnerBytes(database, insert); !room.ok()) return room;
  InsertJob(database, insert);
  absl::StatusOr<StoredJob> stored = Read(database, insert.name, JobPart::kHeader);
  if (stored.ok()) stored->created = true;
  return stored;
}

absl::StatusOr<std::uint64_t> Change(Database& database, const JobChange& change,
                                     std::uint64_t epoch) {
  Query job(database,
            "SELECT number, epoch, last_sequence, state IN (3,4,5) FROM jobs WHERE name=?",
            change.name);
  if (!job.Next()) return NoSuchJob(change.name);
  const std::int64_t number = job.Integer(0);
  const auto last = static_cast<std::uint64_t>(job.Integer(2));
  if (static_cast<std::uint64_t>(job.Integer(1)) != epoch || job.Integer(3) != 0) {
    return HasOtherOwner(change.name);
  }
  Execute(database, "UPDATE jobs SET epoch=epoch+?, last_sequence=?, bytes=bytes+? WHERE number=?",
          change.take, last + change.events.size(), BytesOf(change.events), number);
  if (change.take) Seal(database, number);
  // First, because it goes with the end of the job.
  if (change.checkpoint) WriteCheckpoint(database, number, last, *change.checkpoint, change.name);
  if (!change.parts.header.empty()) WriteParts(database, number, change);
  InsertEvents(database, number, last, change.events, change.name);
  return last + 1;
}

absl::Status MarkCancelRequested(Database& database, const std::string& name) {
  Query job(database, "SELECT number FROM jobs WHERE name=?", name);
  if (!job.Next()) return NoSuchJob(name);
  Execute(database, "UPDATE jobs SET cancel_requested=1 WHERE number=?", job.Integer(0));
  Seal(database, job.Integer(0));
  return absl::OkStatus();
}

absl::StatusOr<JobOwner> Remark(Database& database, const JobRemark& remark) {
  Query job(database, "SELECT number, owner, tenant FROM jobs WHERE name=?", remark.name);
  if (!job.Next()) return NoSuchJob(remark.name);
  if (absl::Status same = CheckUid(database, remark.name, remark.expected_uid); !same.ok()) {
    return same;
  }
  const std::int64_t number = job.Integer(0);
  if (remark.labels) ReplaceLabels(database, number, remark);
  if (remark.note) {
    Execute(database, "UPDATE jobs SET note_crc32=?, note=? WHERE number=?",
            Checksum(*remark.note, 0, remark.name), Query::Blob{*remark.note}, number);
  }
  return JobOwner{job.Bytes(1), job.Bytes(2)};
}

absl::StatusOr<JobOwner> Remove(Database& database, const std::string& name,
                                const std::string& expected_uid) {
  if (absl::Status same = CheckUid(database, name, expected_uid); !same.ok()) return same;
  const absl::StatusOr<EndedRow> job = FindEnded(database, name);
  if (!job.ok()) return job.status();
  Execute(database, "INSERT INTO removed(job) VALUES(?)", job->number);
  Execute(database, "DELETE FROM jobs WHERE number=?", job->number);
  return job->whose;
}

absl::StatusOr<JobOwner> Compact(Database& database, const std::string& name) {
  const absl::StatusOr<EndedRow> job = FindEnded(database, name);
  if (!job.ok()) return job.status();
  Query last(database,
             "SELECT sequence FROM events WHERE job=? AND kind=? ORDER BY sequence DESC LIMIT 1",
             job->number, v1::Event::kFrameChunk);
  const std::int64_t sequence = last.Next() ? last.Integer(0) : 0;
  Execute(database, "UPDATE jobs SET compacted=1, oldest_sequence=? WHERE number=?", sequence + 1,
          job->number);
  Seal(database, job->number);
  if (sequence == 0) return job->whose;
  Execute(database, "INSERT OR IGNORE INTO compacting(job, position) VALUES(?, 0)", job->number);
  return job->whose;
}

}  // namespace contact
