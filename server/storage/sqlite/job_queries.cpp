#include "storage/sqlite/job_queries.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "storage/refusals.h"
#include "storage/rows.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite/row_checksum.h"
#include "storage/sqlite/schema.h"

namespace contact {
namespace {

// The first words of a query for RowOf.
std::string SelectJob() {
  return absl::StrCat(
      "SELECT number, name, state, epoch, cancel_requested, last_sequence, crc32, header,"
      " oldest_sequence, compacted, owner, tenant, request_id, labels_crc32, labels, note_crc32,"
      " note, row_crc32=",
      kRowChecksum, " FROM jobs ");
}

struct JobRow {
  std::int64_t number = 0;
  StoredJob stored;
};

JobRow RowOf(const Query& query) {
  JobRow row;
  row.number = query.Integer(0);
  row.stored = ToStored({.name = query.Bytes(1),
                         .state = static_cast<int>(query.Integer(2)),
                         .epoch = static_cast<std::uint64_t>(query.Integer(3)),
                         .cancel_requested = query.Integer(4) != 0,
                         .last_sequence = static_cast<std::uint64_t>(query.Integer(5)),
                         .crc32 = query.Integer(6),
                         .header = query.Bytes(7),
                         .oldest_sequence = static_cast<std::uint64_t>(query.Integer(8)),
                         .compacted = query.Integer(9) != 0,
                         .owner = query.Bytes(10),
                         .tenant = query.Bytes(11),
                         .request_key = query.Bytes(12),
                         .labels_crc32 = query.Integer(13),
                         .labels = query.Bytes(14),
                         .note_crc32 = query.Integer(15),
                         .note = query.Bytes(16),
                         .sealed = query.Integer(17) != 0});
  return row;
}

StoredEvent EventOf(const Query& query, const std::string& job) {
  const auto sequence = static_cast<std::uint64_t>(query.Integer(0));
  return ToStored(sequence, static_cast<int>(query.Integer(4)),
                  {static_cast<Coding>(query.Integer(2)), query.Bytes(3)}, query.Integer(1),
                  sequence, job);
}

// Adds the spec, if there is one.
void ReadSpec(Database& database, JobRow& row) {
  Query query(database, "SELECT crc32, spec FROM specs WHERE job=?", row.number);
  if (query.Next()) MergeSpec(query.Bytes(1), query.Integer(0), &row.stored);
}

void ReadResult(Database& database, JobRow& row) {
  Query query(database, "SELECT crc32, result FROM results WHERE job=?", row.number);
  if (!query.Next()) return;
  row.stored.result_crc32 = query.Integer(0);
  row.stored.result = query.Bytes(1);
}

void ReadCheckpoint(Database& database, JobRow& row) {
  Query query(database, "SELECT crc32, state, sequence FROM checkpoints WHERE job=?", row.number);
  if (!query.Next()) return;
  AddCheckpoint(query.Bytes(1), query.Integer(0), static_cast<std::uint64_t>(query.Integer(2)),
                &row.stored);
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
  if (part != JobPart::kHeader) ReadSpec(database, row);
  if (part == JobPart::kRun) ReadCheckpoint(database, row);
  if (part == JobPart::kAll) ReadResult(database, row);
  return IfIntact(std::move(row.stored));
}

}  // namespace

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
  page.position = query.after + std::min(kMostScanned, last - query.after);
  Query rows(database,
             "SELECT sequence, crc32, coding, payload, kind FROM events WHERE job=? AND sequence>?"
             " AND sequence<=? AND (1<<kind)&? ORDER BY sequence",
             job.Integer(0), query.after, page.position, query.kinds);
  for (std::size_t bytes = 0; rows.Next();) {
    if (bytes >= query.max_bytes) {
      page.position = page.events.back().sequence;
      break;
    }
    const StoredEvent& event = page.events.emplace_back(EventOf(rows, query.name));
    bytes += DecodedSize(event.coding, event.bytes) + 1;
  }
  return page;
}

}  // namespace contact
