#include "storage/postgres/statements.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <utility>

#include "contact/v1/event.pb.h"
#include "storage/checksum.h"
#include "storage/refusals.h"
#include "storage/rows.h"

namespace contact::postgres {
namespace {

// Sequences from here on are not stored; the sum of one and a page stays a bigint.
constexpr std::uint64_t kMostSequence = std::uint64_t{1} << 62;

// The job of a row whose columns from `first` on are kHeader.
StoredJob HeaderOf(const Rows& rows, int row, int first = 0) {
  const auto column = [first](int place) { return first + place; };
  return ToStored({.name = rows.Bytes(row, column(1)),
                   .state = static_cast<int>(rows.Integer(row, column(2))),
                   .epoch = static_cast<std::uint64_t>(rows.Integer(row, column(3))),
                   .cancel_requested = rows.Integer(row, column(4)) != 0,
                   .last_sequence = static_cast<std::uint64_t>(rows.Integer(row, column(5))),
                   .crc32 = rows.Integer(row, column(6)),
                   .header = rows.Bytes(row, column(7)),
                   .oldest_sequence = static_cast<std::uint64_t>(rows.Integer(row, column(8))),
                   .compacted = rows.Integer(row, column(9)) != 0,
                   .owner = rows.Bytes(row, column(10)),
                   .tenant = rows.Bytes(row, column(11)),
                   .request_key = rows.Bytes(row, column(12)),
                   .labels_crc32 = rows.Integer(row, column(13)),
                   .labels = rows.Bytes(row, column(14)),
                   .note_crc32 = rows.Integer(row, column(15)),
                   .note = rows.Bytes(row, column(16))});
}

// Of the columns of read_job.
constexpr int kSpecColumn = 17;
constexpr int kCheckpointColumn = kSpecColumn + 2;
constexpr int kResultColumn = kCheckpointColumn + 3;

// Adds spec and checkpoint to the job of a row whose columns from `first` on are those of read_job.
void MergeRunParts(const Rows& rows, int row, int first, StoredJob* stored) {
  const int spec = first + kSpecColumn;
  const int checkpoint = first + kCheckpointColumn;
  if (!rows.IsNull(row, spec)) {
    MergeSpec(rows.Bytes(row, spec + 1), rows.Integer(row, spec), stored);
  }
  if (!rows.IsNull(row, checkpoint)) {
    AddCheckpoint(rows.Bytes(row, checkpoint + 1), rows.Integer(row, checkpoint),
                  static_cast<std::uint64_t>(rows.Integer(row, checkpoint + 2)), stored);
  }
}

// The job of a row whose columns from `first` on are those of read_job.
absl::StatusOr<StoredJob> WholeOf(const Rows& rows, int first) {
  StoredJob stored = HeaderOf(rows, 0, first);
  MergeRunParts(rows, 0, first, &stored);
  const int result = first + kResultColumn;
  if (!rows.IsNull(0, result)) {
    stored.result_crc32 = rows.Integer(0, result);
    stored.result = rows.Bytes(0, result + 1);
  }
  return IfIntact(std::move(stored));
}

void AddLabels(const JobLabels& labels, Parameters* parameters) {
  std::vector<std::string> keys, values;
  for (const auto& [key, value] : labels) {
    keys.push_back(key);
    values.push_back(value);
  }
  parameters->Texts(keys).Texts(values);
}

char OutcomeOf(const Rows& rows) { return rows.Bytes(0, 0).front(); }

// The owner of a row with outcome, owner, tenant and, where the outcome may be U, uid; if it is D.
absl::StatusOr<JobOwner> IfDone(const Rows& rows, const std::string& name) {
  switch (OutcomeOf(rows)) {
    case 'D':
      return JobOwner{rows.Bytes(0, 1), rows.Bytes(0, 2)};
    case 'R':
      return HasNotEnded(name);
    case 'U': {
      v1::Job other;
      other.set_name(name);
      other.set_uid(rows.Bytes(0, 3));
      return OtherJob(other);
    }
    default:
      return NoSuchJob(name);
  }
}

}  // namespace

// In the order of read_job.
const char kHeader[] =
    "number, name, state, epoch, cancel_requested, last_sequence, crc32, header, oldest_sequence,"
    " compacted, owner, tenant, request_id, labels_crc32, labels, note_crc32, note";

// Only the database knows their sequences, so their checksums have none.
void AddEvents(const std::string& job, const std::vector<EventRow>& events,
               Parameters* parameters) {
  std::vector<std::int64_t> kinds, codings, sizes, checksums;
  std::vector<const std::string*> payloads;
  for (const auto& [kind, event] : events) {
    kinds.push_back(kind);
    codings.push_back(static_cast<std::int64_t>(event.coding));
    sizes.push_back(static_cast<std::int64_t>(DecodedSize(event.coding, event.bytes)));
    checksums.push_back(Checksum(event, 0, job));
    payloads.push_back(&event.bytes);
  }
  parameters->Integers(kinds).Integers(codings).Integers(sizes).Integers(checksums);
  parameters->Blobs(payloads).Integer(static_cast<std::int64_t>(BytesOf(events)));
}

Statement CreateJob(const JobInsert& job) {
  const JobParts& parts = job.parts;
  Parameters parameters;
  parameters.Bytes(job.name).Bytes(job.uid);
  if (job.request_key.empty()) {
    parameters.Null();
  } else {
    parameters.Bytes(job.request_key);
  }
  parameters.Bytes(job.whose.owner).Bytes(job.whose.tenant).Integer(job.state);
  parameters.Integer(parts.end_time).Integer(Checksum(parts.header)).Bytes(parts.header);
  parameters.Integer(Checksum(parts.spec, 0, job.name)).Bytes(parts.spec);
  AddLabels(job.labels, &parameters);
  AddEvents(job.name, job.events, &parameters);
  parameters.Boolean(job.may_create).Integer(job.max_owner_bytes);
  parameters.Integer(job.priority).Integer(job.cells).Integer(job.limits.waiting);
  parameters.Integer(job.limits.owner_jobs).Integer(job.limits.owner_cells);
  return {
      "SELECT c.*, j.* FROM contactd.create_job($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13,$14,$15,"
      "$16,$17,$18,$19,$20,$21,$22,$23,$24,$25,$26) c LEFT JOIN LATERAL "
      "contactd.read_job(c.existing, NULL,"
      " c.outcome = 'F', false, c.outcome = 'F') j ON c.outcome IN ('C', 'F')",
      std::move(parameters)};
}

absl::StatusOr<StoredJob> Created(const Rows& rows, const std::string& name) {
  switch (const char outcome = OutcomeOf(rows)) {
    case 'U':
      return RequestIdWasUsed(rows.Bytes(0, 1));
    case 'N':
      return MayNotBeNew();
    case 'O':
      return TooMuch(kOwnerBytesPayload, rows.Integer(0, 2));
    case 'W':
      return TooMuch(kWaitingPayload, rows.Integer(0, 2));
    case 'J':
      return TooMuch(kOwnerJobsPayload, rows.Integer(0, 2));
    case 'K':
      return TooMuch(kOwnerCellsPayload, rows.Integer(0, 2));
    default: {
      if (rows.IsNull(0, 3)) return NoSuchJob(name);
      absl::StatusOr<StoredJob> stored = WholeOf(rows, 3);
      if (stored.ok()) stored->created = outcome == 'C';
      return stored;
    }
  }
}

Statement ChangeJob(const JobChange& change, std::uint64_t epoch) {
  const JobParts& parts = change.parts;
  Parameters parameters;
  parameters.Bytes(change.name).Integer(static_cast<std::int64_t>(epoch));
  parameters.Integer(static_cast<std::int64_t>(change.id)).Boolean(change.take);
  if (parts.header.empty()) {
    parameters.Null().Null().Null().Null();
  } else {
    parameters.Integer(change.state).Integer(parts.end_time);
    parameters.Integer(Checksum(parts.header)).Bytes(parts.header);
  }
  if (parts.result.empty()) {
    parameters.Null().Null();
  } else {
    parameters.Integer(Checksum(parts.result, 0, change.name)).Bytes(parts.result);
  }
  if (change.checkpoint) {
    parameters.Integer(static_cast<std::int64_t>(change.checkpoint->events));
    parameters.Integer(Checksum(change.checkpoint->state, 0, change.name));
    parameters.Bytes(change.checkpoint->state);
  } else {
    parameters.Null().Null().Null();
  }
  AddEvents(change.name, change.events, &parameters);
  return {
      "SELECT * FROM "
      "contactd.change_job($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13,$14,$15,$16,$17,"
      "$18,$19)",
      std::move(parameters)};
}

absl::StatusOr<std::uint64_t> Changed(const Rows& rows, const std::string& name) {
  switch (OutcomeOf(rows)) {
    case 'D':
      return static_cast<std::uint64_t>(rows.Integer(0, 1));
    case 'O':
      return HasOtherOwner(name);
    default:
      return NoSuchJob(name);
  }
}

Statement RequestCancel(const std::string& name) {
  return {"SELECT contactd.request_cancel($1)", Parameters().Bytes(name)};
}

absl::StatusOr<bool> Done(const Rows& rows, const std::string& name) {
  if (OutcomeOf(rows) != 'D') return NoSuchJob(name);
  return true;
}

Statement RemarkJob(const JobRemark& remark) {
  Parameters parameters;
  parameters.Bytes(remark.name).Bytes(remark.expected_uid);
  if (remark.labels) {
    std::string bytes = BytesOf(*remark.labels);
    parameters.Integer(Checksum(bytes, 0, remark.name));
    parameters.Bytes(std::move(bytes));
  } else {
    parameters.Null().Null();
  }
  AddLabels(remark.labels.value_or(JobLabels{}), &parameters);
  if (remark.note) {
    parameters.Integer(Checksum(*remark.note, 0, remark.name)).Bytes(*remark.note);
  } else {
    parameters.Null().Null();
  }
  return {"SELECT * FROM contactd.remark_job($1,$2,$3,$4,$5,$6,$7,$8)", std::move(parameters)};
}

absl::StatusOr<JobOwner> Remarked(const Rows& rows, const std::string& name) {
  return IfDone(rows, name);
}

Statement ReadJob(const std::string& name, std::optional<std::string> tenant, JobPart part) {
  Parameters parameters;
  parameters.Bytes(name);
  if (tenant) {
    parameters.Bytes(*std::move(tenant));
  } else {
    parameters.Null();
  }
  parameters.Boolean(part != JobPart::kHeader).Boolean(part == JobPart::kRun);
  parameters.Boolean(part == JobPart::kAll);
  return {"SELECT * FROM contactd.read_job($1,$2,$3,$4,$5)", std::move(parameters)};
}

absl::StatusOr<StoredJob> JobOf(const Rows& rows, const std::string& name) {
  if (rows.size() == 0) return NoSuchJob(name);
  return WholeOf(rows, 0);
}

Statement FindOwner(const std::string& tenant, const std::string& name) {
  return {"SELECT contactd.owner_of($1,$2)", Parameters().Bytes(tenant).Bytes(name)};
}

absl::StatusOr<JobOwner> OwnerOf(const Rows& rows, const std::string& name,
                                 const std::string& tenant) {
  if (rows.IsNull(0, 0)) return NoSuchJob(name);
  return JobOwner{rows.Bytes(0, 0), tenant};
}

Statement SumBytes(const JobOwner& whose) {
  return {"SELECT contactd.bytes_of($1,$2)", Parameters().Bytes(whose.tenant).Bytes(whose.owner)};
}

Statement ListJobs(const JobQuery& query) {
  Parameters parameters;
  parameters.Integer(query.before > 0 ? query.before : INT64_MAX);
  if (query.tenant) {
    parameters.Bytes(*query.tenant);
  } else {
    parameters.Null();
  }
  parameters.Integers({query.states.begin(), query.states.end()});
  AddLabels(query.labels, &parameters);
  parameters.Bytes(query.name_prefix).Integer(query.limit + 1);
  return {absl::StrCat("SELECT ", kHeader, " FROM contactd.list_jobs($1,$2,$3,$4,$5,$6,$7)"),
          std::move(parameters)};
}

absl::StatusOr<JobPage> PageOf(const Rows& rows, int limit) {
  JobPage page;
  const int shown = std::min(rows.size(), limit);
  for (int row = 0; row < shown; ++row) page.jobs.push_back(HeaderOf(rows, row));
  if (rows.size() > limit) page.next = rows.Integer(limit - 1, 0);
  return page;
}

// For a process that has the jobs alone, as the owner of the tables.
Statement ListUnfinished() {
  return {absl::StrCat("SELECT ", kHeader,
                       " FROM contactd.jobs WHERE state NOT IN (3,4,5) ORDER BY number")};
}

absl::StatusOr<std::vector<StoredJob>> JobsOf(const Rows& rows) {
  std::vector<StoredJob> jobs;
  for (int row = 0; row < rows.size(); ++row) jobs.push_back(HeaderOf(rows, row));
  return jobs;
}

std::vector<StoredJob> ClaimedOf(const Rows& rows) {
  std::vector<StoredJob> jobs;
  for (int row = 0; row < rows.size(); ++row) {
    jobs.push_back(HeaderOf(rows, row));
    StoredJob whole = jobs.back();
    MergeRunParts(rows, row, 0, &whole);
    if (whole.intact) jobs.back() = std::move(whole);
  }
  return jobs;
}

Statement ListSizes() { return {"SELECT name, end_time, bytes FROM contactd.job_sizes()"}; }

absl::StatusOr<std::vector<JobSize>> SizesOf(const Rows& rows) {
  std::vector<JobSize> sizes;
  for (int row = 0; row < rows.size(); ++row) {
    sizes.push_back({rows.Bytes(row, 0), rows.Integer(row, 1), rows.Integer(row, 2)});
  }
  return sizes;
}

Statement ReadEvents(const EventQuery& query) {
  Parameters parameters;
  parameters.Bytes(query.name);
  parameters.Integer(static_cast<std::int64_t>(std::min(query.after, kMostSequence)));
  parameters.Integer(query.kinds).Integer(static_cast<std::int64_t>(query.max_bytes));
  parameters.Integer(kMostScanned);
  return {
      "SELECT last_sequence, oldest_sequence, sequence, kind, coding, crc32, payload, size"
      " FROM contactd.read_events($1,$2,$3,$4,$5)",
      std::move(parameters)};
}

absl::StatusOr<EventPage> EventsOf(const Rows& rows, const EventQuery& query) {
  if (rows.size() == 0) return NoSuchJob(query.name);
  const auto last = static_cast<std::uint64_t>(rows.Integer(0, 0));
  EventPage page;
  page.oldest = static_cast<std::uint64_t>(rows.Integer(0, 1));
  page.position = query.after;
  if (query.after >= last) return page;
  page.position = query.after + std::min(kMostScanned, last - query.after);
  std::size_t bytes = 0;
  for (int row = 1; row < rows.size(); ++row) {  // The first row has no event.
    page.events.push_back(ToStored(static_cast<std::uint64_t>(rows.Integer(row, 2)),
                                   static_cast<int>(rows.Integer(row, 3)),
                                   {static_cast<Coding>(rows.Integer(row, 4)), rows.Bytes(row, 6)},
                                   rows.Integer(row, 5), 0, query.name));
    bytes += static_cast<std::size_t>(rows.Integer(row, 7)) + 1;
  }
  // The page may have ended before all that it could step over.
  if (bytes >= query.max_bytes) page.position = page.events.back().sequence;
  return page;
}

Statement RemoveJob(const std::string& name, const std::string& expected_uid) {
  return {"SELECT * FROM contactd.remove_job($1,$2)", Parameters().Bytes(name).Bytes(expected_uid)};
}

absl::StatusOr<JobOwner> Removed(const Rows& rows, const std::string& name) {
  return IfDone(rows, name);
}

Statement CompactJob(const std::string& name) {
  return {"SELECT * FROM contactd.compact_job($1,$2)",
          Parameters().Bytes(name).Integer(v1::Event::kFrameChunk)};
}

absl::StatusOr<JobOwner> Compacted(const Rows& rows, const std::string& name) {
  return IfDone(rows, name);
}

Statement Purge() {
  return {"SELECT contactd.purge($1)", Parameters().Integer(v1::Event::kFrameChunk)};
}

}  // namespace contact::postgres
