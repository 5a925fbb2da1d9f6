#include "storage/job_changes.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <utility>

#include "storage/checksum.h"
#include "storage/database.h"
#include "storage/job_queries.h"
#include "storage/schema.h"

namespace contact {
namespace {

// The log of a job may have gigabytes, and whoever wants to commit waits for one sweep.
constexpr std::size_t kSweptEvents = 32;
// The same for those that are only stepped over.
constexpr std::int64_t kScannedEvents = 4096;

void InsertEvents(Database& database, std::int64_t job, std::uint64_t last,
                  const std::vector<EventRow>& events) {
  for (const EventRow& row : events) {
    ++last;
    Query(database,
          "INSERT INTO events(job, sequence, kind, coding, crc32, payload) VALUES(?,?,?,?,?,?)",
          job, last, row.kind, row.event.coding, Checksum(row.event, last),
          Query::Blob{row.event.bytes})
        .Run();
  }
}

std::size_t BytesOf(const std::vector<EventRow>& events) {
  std::size_t bytes = 0;
  for (const EventRow& row : events) bytes += row.event.bytes.size();
  return bytes;
}

void WriteCheckpoint(Database& database, std::int64_t job, std::uint64_t last,
                     const Checkpoint& checkpoint) {
  Query(database, "REPLACE INTO checkpoints(job, sequence, crc32, state) VALUES(?,?,?,?)", job,
        last + checkpoint.events, Checksum(checkpoint.state), Query::Blob{checkpoint.state})
      .Run();
}

// Replaces what is stored of a job beside its log.
void WriteParts(Database& database, std::int64_t job, const JobChange& change) {
  const JobParts& parts = change.parts;
  Query(database, "UPDATE jobs SET state=?, end_time=?, crc32=?, header=? WHERE number=?",
        change.state, parts.end_time, Checksum(parts.header), Query::Blob{parts.header}, job)
      .Run();
  if (parts.end_time > 0) Query(database, "DELETE FROM checkpoints WHERE job=?", job).Run();
  if (parts.result.empty()) return;
  Query(database,
        "UPDATE jobs SET bytes=bytes+?2-"
        "COALESCE((SELECT LENGTH(result) FROM results WHERE job=?1), 0) WHERE number=?1",
        job, parts.result.size())
      .Run();
  Query(database, "REPLACE INTO results(job, crc32, result) VALUES(?,?,?)", job,
        Checksum(parts.result), Query::Blob{parts.result})
      .Run();
}

void InsertJob(Database& database, const JobInsert& insert) {
  const JobParts& parts = insert.parts;
  Query(database,
        "INSERT INTO jobs(name, request_id, state, epoch, last_sequence, end_time, bytes, crc32,"
        " header) VALUES(?, NULLIF(?, ''), ?, 0, ?, ?, ?, ?, ?)",
        insert.name, insert.request_id, insert.state, insert.events.size(), parts.end_time,
        parts.spec.size() + BytesOf(insert.events), Checksum(parts.header),
        Query::Blob{parts.header})
      .Run();
  const std::int64_t job = database.LastInsertRowid();
  Query(database, "INSERT INTO specs(job, crc32, spec) VALUES(?,?,?)", job, Checksum(parts.spec),
        Query::Blob{parts.spec})
      .Run();
  for (const auto& [key, value] : insert.labels) {
    Query(database, "INSERT INTO labels(key, value, job) VALUES(?,?,?)", key, value, job).Run();
  }
  InsertEvents(database, job, 0, insert.events);
}

// Name of the job that a request with this id has made; empty if there is none.
std::string MadeBy(Database& database, const std::string& request_id) {
  if (request_id.empty()) return "";
  Query query(database, "SELECT name FROM jobs WHERE request_id=?", request_id);
  return query.Next() ? query.Bytes(0) : "";
}

bool HasSpec(Database& database, const std::string& name, const std::string& spec) {
  Query query(database, "SELECT spec FROM specs WHERE job=(SELECT number FROM jobs WHERE name=?)",
              name);
  return query.Next() && query.Bytes(0) == spec;
}

// Number of the job, if it has ended.
absl::StatusOr<std::int64_t> FindEnded(Database& database, const std::string& name) {
  Query job(database, absl::StrCat("SELECT number, ", kEnded, " FROM jobs WHERE name=?"), name);
  if (!job.Next()) return NoSuchJob(name);
  if (job.Integer(1) != 0) return job.Integer(0);
  return absl::FailedPreconditionError(absl::StrCat(name, " has not ended"));
}

// Some events of a job that was removed. False: there is none.
bool PurgeRemoved(Database& database) {
  Query removed(database, "SELECT job FROM removed LIMIT 1");
  if (!removed.Next()) return false;
  const std::int64_t job = removed.Integer(0);
  Query events(database,
               "DELETE FROM events WHERE job=?1 AND sequence<"
               "(SELECT MIN(sequence) FROM events WHERE job=?1)+?2",
               job, kSweptEvents);
  if (events.Run() == 0) Query(database, "DELETE FROM removed WHERE job=?", job).Run();
  return true;
}

// Some frame chunks of a job that is being compacted, from its position on. False: there is none.
bool PurgeCompacted(Database& database) {
  Query compacting(database,
                   "SELECT job, position, oldest_sequence FROM compacting, jobs WHERE job=number"
                   " LIMIT 1");
  if (!compacting.Next()) return false;
  const std::int64_t job = compacting.Integer(0);
  const std::int64_t position = compacting.Integer(1);
  std::int64_t next = std::min(position + kScannedEvents, compacting.Integer(2));
  std::vector<std::pair<std::int64_t, std::int64_t>> chunks;  // Sequence and bytes.
  Query events(database,
               "SELECT sequence, LENGTH(payload) FROM events WHERE job=? AND sequence>? AND"
               " sequence<=? AND kind=? ORDER BY sequence LIMIT ?",
               job, position, next, v1::Event::kFrameChunk, kSweptEvents);
  while (events.Next()) chunks.emplace_back(events.Integer(0), events.Integer(1));
  if (chunks.size() == kSweptEvents) next = chunks.back().first;
  std::int64_t bytes = 0;
  for (const auto& [sequence, size] : chunks) {
    Query(database, "DELETE FROM events WHERE job=? AND sequence=?", job, sequence).Run();
    bytes += size;
  }
  Query(database, "UPDATE jobs SET bytes=bytes-? WHERE number=?", bytes, job).Run();
  if (next >= compacting.Integer(2)) {
    Query(database, "DELETE FROM compacting WHERE job=?", job).Run();
  } else {
    Query(database, "UPDATE compacting SET position=? WHERE job=?", next, job).Run();
  }
  return true;
}

}  // namespace

absl::StatusOr<StoredJob> Insert(Database& database, const JobInsert& insert) {
  if (const std::string name = MadeBy(database, insert.request_id); !name.empty()) {
    if (HasSpec(database, name, insert.parts.spec)) return Read(database, name, JobPart::kAll);
    return absl::AlreadyExistsError(absl::StrCat("request_id was used with another job, ", name));
  }
  if (!insert.may_create) return absl::ResourceExhaustedError("the job is new");
  InsertJob(database, insert);
  absl::StatusOr<StoredJob> stored = Read(database, insert.name, JobPart::kHeader);
  if (stored.ok()) stored->created = true;
  return stored;
}

absl::StatusOr<std::uint64_t> Change(Database& database, const JobChange& change,
                                     std::uint64_t epoch) {
  Query job(database, "SELECT number, epoch, last_sequence FROM jobs WHERE name=?", change.name);
  if (!job.Next()) return NoSuchJob(change.name);
  const std::int64_t number = job.Integer(0);
  const auto last = static_cast<std::uint64_t>(job.Integer(2));
  if (static_cast<std::uint64_t>(job.Integer(1)) != epoch) {
    return absl::AbortedError(absl::StrCat(change.name, " has another owner"));
  }
  Query(database, "UPDATE jobs SET epoch=epoch+?, last_sequence=?, bytes=bytes+? WHERE number=?",
        change.take, last + change.events.size(), BytesOf(change.events), number)
      .Run();
  // First, because it goes with the end of the job.
  if (change.checkpoint) WriteCheckpoint(database, number, last, *change.checkpoint);
  if (!change.parts.header.empty()) WriteParts(database, number, change);
  InsertEvents(database, number, last, change.events);
  return last + 1;
}

absl::Status MarkCancelRequested(Database& database, const std::string& name) {
  Query update(database, "UPDATE jobs SET cancel_requested=1 WHERE name=?", name);
  return update.Run() == 1 ? absl::OkStatus() : NoSuchJob(name);
}

absl::Status Remove(Database& database, const std::string& name, const std::string& expected_uid) {
  if (!expected_uid.empty()) {
    const absl::StatusOr<StoredJob> stored = Read(database, name, JobPart::kHeader);
    if (!stored.ok()) return stored.status();
    if (stored->job.uid() != expected_uid) return OtherJob(stored->job);
  }
  const absl::StatusOr<std::int64_t> job = FindEnded(database, name);
  if (!job.ok()) return job.status();
  Query(database, "INSERT INTO removed(job) VALUES(?)", *job).Run();
  Query(database, "DELETE FROM jobs WHERE number=?", *job).Run();
  return absl::OkStatus();
}

absl::Status Compact(Database& database, const std::string& name) {
  const absl::StatusOr<std::int64_t> job = FindEnded(database, name);
  if (!job.ok()) return job.status();
  Query last(database,
             "SELECT sequence FROM events WHERE job=? AND kind=? ORDER BY sequence DESC LIMIT 1",
             *job, v1::Event::kFrameChunk);
  const std::int64_t sequence = last.Next() ? last.Integer(0) : 0;
  Query(database, "UPDATE jobs SET compacted=1, oldest_sequence=? WHERE number=?", sequence + 1,
        *job)
      .Run();
  if (sequence == 0) return absl::OkStatus();
  Query(database, "INSERT OR IGNORE INTO compacting(job, position) VALUES(?, 0)", *job).Run();
  return absl::OkStatus();
}

bool Purge(Database& database) { return PurgeRemoved(database) || PurgeCompacted(database); }

}  // namespace contact
