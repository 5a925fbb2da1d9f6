#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/job_parts.h"
#include "storage/records.h"

namespace contact {

class Database;

/// Operations that change the tables, each inside the transaction of its caller. One that returns
/// an error has changed nothing. SQL errors are thrown as SQLite::Exception.

struct JobInsert {
  std::string name;
  std::string request_id;
  int state = 0;
  std::vector<std::pair<std::string, std::string>> labels;
  JobParts parts;
  std::vector<EventRow> events;
  bool may_create = true;
};
/// Stores a job, or finds the one that the same request has made: see Store::Create.
absl::StatusOr<StoredJob> Insert(Database& database, const JobInsert& insert);

struct JobChange {
  std::string name;
  bool take = false;
  int state = 0;
  JobParts parts;  ///< Header empty: the job stays; the spec is not looked at.
  std::vector<EventRow> events;
  std::optional<Checkpoint> checkpoint;
};
/// Returns the sequence of the first event appended: see Store::Update.
absl::StatusOr<std::uint64_t> Change(Database& database, const JobChange& change,
                                     std::uint64_t epoch);

/// Remembers that a user wants the job cancelled: see Store::RequestCancel.
absl::Status MarkCancelRequested(Database& database, const std::string& name);

/// Removes an ended job: see Store::Delete. Its events only vanish from sight.
absl::Status Remove(Database& database, const std::string& name, const std::string& expected_uid);

/// Gives up the frame chunks of an ended job: see Store::Compact. They only vanish from sight.
absl::Status Compact(Database& database, const std::string& name);

/// Removes some of the events that have vanished from sight. False: there are none.
bool Purge(Database& database);

}  // namespace contact
