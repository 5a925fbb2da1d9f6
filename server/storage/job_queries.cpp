#include "storage/job_queries.h"

#include <absl/strings/cord.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/spelling.h"
#include "storage/checksum.h"
#include "storage/database.h"
#include "storage/job_parts.h"
#include "storage/schema.h"

namespace contact {
namespace {

// Rows that one ReadEvents steps over at most, so that a filter that lets little through does not
// hold up the commits behind it.
constexpr std::uint64_t kMaxScan = 4096;

// The first words of a query for RowOf.
std::string SelectJob() {
  return absl::StrCat(
      "SELECT number, name, state, epoch, cancel_requested, last_sequence, crc32, header,"
      " oldest_sequence, compacted, owner, tenant, row_crc32=",
      kRowChecksum, " FROM jobs ");
}

struct JobRow {
  std::int64_t number = 0;
  StoredJob stored;
};

JobRow RowOf(const Query& query) {
  JobRow row;
  row.number = query.Integer(0);
  v1::Job& job = row.stored.job;
  const std::string name = query.Bytes(1);
  const std::string header = query.Bytes(7);
  const std::string owner = query.Bytes(10);
  const std::string tenant = query.Bytes(11);
  row.stored.intact = query.Integer(12) != 0 && Checksum(header) == query.Integer(6) &&
                      job.ParseFromString(header) && job.name() == name && OwnerOf(job) == owner &&
                      TenantOf(job) == tenant;
  if (!row.stored.intact) job.Clear();
  job.set_name(name);
  job.set_owner(owner);
  job.set_tenant(tenant);
  job.set_state(static_cast<v1::Job::State>(query.Integer(2)));
  row.stored.epoch = static_cast<std::uint64_t>(query.Integer(3));
  row.stored.cancel_requested = query.Integer(4) != 0;
  row.stored.compacted = query.Integer(9) != 0;
  job.set_oldest_sequence(static_cast<std::uint64_t>(query.Integer(8)));
  job.set_last_sequence(static_cast<std::uint64_t>(query.Integer(5)));
  return row;
}

StoredEvent EventOf(const Query& query) {
  StoredEvent event;
  event.sequence = static_cast<std::uint64_t>(query.Integer(0));
  event.kind = static_cast<v1::Event::PayloadCase>(query.Integer(4));
  CodedEvent coded{static_cast<Coding>(query.Integer(2)), query.Bytes(3)};
  event.intact = Checksum(coded, event.sequence) == query.Integer(1);
  if (!event.intact) return event;
  event.coding = coded.coding;
  event.bytes = std::move(coded.bytes);
  return event;
}

// Adds the bytes that `sql` finds for the job, if any.
void MergePart(Database& database, const std::string& sql, JobRow& row) {
  Query query(database, sql, row.number);
  if (!query.Next()) return;
  const std::string bytes = query.Bytes(1);
  row.stored.intact = row.stored.intact && Checksum(bytes) == query.Integer(0) &&
                      row.stored.job.MergeFromString(bytes);
}

void AddResult(Database& database, JobRow& row) {
  Query query(database, "SELECT crc32, result FROM results WHERE job=?", row.number);
  if (!query.Next()) return;
  row.stored.result_crc32 = query.Integer(0);
  row.stored.result = query.Bytes(1);
}

void AddCheckpoint(Database& database, JobRow& row) {
  Query query(database, "SELECT crc32, state, sequence FROM checkpoints WHERE job=?", row.number);
  if (!query.Next()) return;
  std::string state = query.Bytes(1);
  if (Checksum(state) != query.Integer(0)) return;
  row.stored.checkpoint = std::move(state);
  row.stored.checkpoint_sequence = static_cast<std::uint64_t>(query.Integer(2));
}

std::string Placeholders(std::size_t count) {
  return absl::StrJoin(std::vector<const char*>(count, "?"), ",");
}

std::string ListSql(const JobQuery& query) {
  std::string sql = absl::StrCat(SelectJob(), "WHERE number<?");
  if (query.tenant) absl::StrAppend(&sql, " AND tenant=?");
  if (!query.states.empty()) {
    absl::StrAppend(&sql, " AND state IN (", Placeholders(query.states.size()), ")");
  }
  for (std::size_t i = 0; i < query.labels.size(); ++i) {
    absl::StrAppend(&sql, " AND number IN (SELECT job FROM labels WHERE key=? AND value=?)");
  }
  if (!query.name_prefix.empty()) absl::StrAppend(&sql, " AND name>=? AND name<?");
  return absl::StrCat(sql, " ORDER BY number DESC LIMIT ?");
}

// Reads the job that the query finds.
absl::StatusOr<StoredJob> ReadFound(Database& database, Query& query, const std::string& name,
                                    JobPart part) {
  if (!query.Next()) return NoSuchJob(name);
  JobRow row = RowOf(query);
  if (part != JobPart::kHeader) {
    MergePart(database, "SELECT crc32, spec FROM specs WHERE job=?", row);
  }
  if (part == JobPart::kRun) AddCheckpoint(database, row);
  if (part == JobPart::kAll) AddResult(database, row);
  if (!row.stored.intact) return FailsChecksum(name);
  return std::move(row.stored);
}

}  // namespace

absl::Status NoSuchJob(const std::string& name) {
  return absl::NotFoundError(absl::StrCat("there is no job ", Shortened(name)));
}

absl::Status FailsChecksum(const std::string& name) {
  return absl::DataLossError(absl::StrCat(name, " fails its checksum in the store"));
}

bool StoredJob::MergeResult() {
  const std::string bytes = std::exchange(result, {});
  return bytes.empty() || (Checksum(bytes) == result_crc32 && job.MergeFromString(bytes));
}

absl::Status OtherJob(const v1::Job& job) {
  absl::Status status =
      absl::AbortedError(absl::StrCat(job.name(), " is another job than the one expected"));
  status.SetPayload(kUidPayload, absl::Cord(job.uid()));
  return status;
}

absl::StatusOr<StoredJob> Read(Database& database, const std::string& name, JobPart part) {
  Query query(database, absl::StrCat(SelectJob(), "WHERE name=?"), name);
  return ReadFound(database, query, name, part);
}

absl::StatusOr<StoredJob> ReadOf(Database& database, const std::string& tenant,
                                 const std::string& name, JobPart part) {
  Query query(database, absl::StrCat(SelectJob(), "WHERE name=? AND tenant=?"), name, tenant);
  return ReadFound(database, query, name, part);
}

absl::StatusOr<JobOwner> FindOwner(Database& database, const std::string& tenant,
                                   const std::string& name) {
  Query query(database, "SELECT owner FROM jobs WHERE name=? AND tenant=?", name, tenant);
  if (!query.Next()) return NoSuchJob(name);
  return JobOwner{query.Bytes(0), tenant};
}

std::int64_t OwnerBytes(Database& database, const JobOwner& whose) {
  Query sum(database, "SELECT bytes FROM temp.owner_bytes WHERE tenant=? AND owner=?", whose.tenant,
            whose.owner);
  return sum.Next() ? sum.Integer(0) : 0;
}

JobPage List(Database& database, const JobQuery& query) {
  Query rows(database, ListSql(query));
  rows.Bind(query.before > 0 ? query.before : INT64_MAX);
  if (query.tenant) rows.Bind(*query.tenant);
  for (const int state : query.states) rows.Bind(state);
  for (const auto& [key, value] : query.labels) {
    rows.Bind(key);
    rows.Bind(value);
  }
  if (!query.name_prefix.empty()) {
    rows.Bind(query.name_prefix);
    rows.Bind(query.name_prefix + '\x7f');  // Above all characters of a name.
  }
  rows.Bind(query.limit + 1);
  JobPage page;
  std::int64_t oldest = 0;
  while (rows.Next()) {
    JobRow row = RowOf(rows);
    if (page.jobs.size() == static_cast<std::size_t>(query.limit)) {
      page.next = oldest;
      break;
    }
    oldest = row.number;
    page.jobs.push_back(std::move(row.stored));
  }
  return page;
}

std::vector<StoredJob> ListUnfinished(Database& database) {
  Query rows(database, absl::StrCat(SelectJob(), "WHERE NOT ", kEnded, " ORDER BY number"));
  std::vector<StoredJob> jobs;
  while (rows.Next()) jobs.push_back(RowOf(rows).stored);
  return jobs;
}

std::vector<JobSize> Sizes(Database& database) {
  Query rows(database, absl::StrCat("SELECT name, end_time, bytes FROM jobs WHERE ", kEnded,
                                    " ORDER BY end_time, number"));
  std::vector<JobSize> sizes;
  while (rows.Next()) sizes.push_back({rows.Bytes(0), rows.Integer(1), rows.Integer(2)});
  return sizes;
}

absl::StatusOr<EventPage> ReadEvents(Database& database, const EventQuery& query) {
  Query job(database, "SELECT number, last_sequence, oldest_sequence FROM jobs WHERE name=?",
            query.name);
  if (!job.Next()) return NoSuchJob(query.name);
  const auto last = static_cast<std::uint64_t>(job.Integer(1));
  EventPage page;
  page.oldest = static_cast<std::uint64_t>(job.Integer(2));
  page.position = query.after;
  if (query.after >= last) return page;
  page.position = query.after + std::min(kMaxScan, last - query.after);
  Query rows(database,
             "SELECT sequence, crc32, coding, payload, kind FROM events WHERE job=? AND sequence>?"
             " AND sequence<=? AND (1<<kind)&? ORDER BY sequence",
             job.Integer(0), query.after, page.position, query.kinds);
  for (std::size_t bytes = 0; rows.Next();) {
    if (bytes >= query.max_bytes) {
      page.position = page.events.back().sequence;
      break;
    }
    const StoredEvent& event = page.events.emplace_back(EventOf(rows));
    bytes += DecodedSize(event.coding, event.bytes) + 1;
  }
  return page;
}

}  // namespace contact
