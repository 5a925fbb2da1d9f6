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

/// A NewJob with its messages serialised.
struct JobInsert {
  std::string name;
  /// Empty: none.
  std::string request_id;
  /// Whose the job is.
  JobOwner whose;
  /// A v1::Job::State.
  int state = 0;
  std::vector<std::pair<std::string, std::string>> labels;
  JobParts parts;
  std::vector<EventRow> events;
  /// See NewJob::may_create.
  bool may_create = true;
  /// See NewJob::max_owner_bytes.
  std::int64_t max_owner_bytes = 0;
};
/// Stores a job, or finds the one that the same request has made: see Store::Create.
absl::StatusOr<StoredJob> Insert(Database& database, const JobInsert& insert);

/// A JobUpdate with its messages serialised, without the epoch that it needs.
struct JobChange {
  std::string name;
  /// See JobUpdate::take.
  bool take = false;
  /// A v1::Job::State; used with `parts` only.
  int state = 0;
  /// With an empty header the stored job stays as it is. The spec is never replaced.
  JobParts parts;
  std::vector<EventRow> events;
  std::optional<Checkpoint> checkpoint;
};
/// Returns the sequence of the first event appended: see Store::Update.
absl::StatusOr<std::uint64_t> Change(Database& database, const JobChange& change,
                                     std::uint64_t epoch);

/// Remembers that a user wants the job cancelled: see Store::RequestCancel.
absl::Status MarkCancelRequested(Database& database, const std::string& name);

/// Removes an ended job: see Store::Delete. Its events only vanish from sight; Purge removes them.
absl::StatusOr<JobOwner> Remove(Database& database, const std::string& name,
                                const std::string& expected_uid);

/// Gives up the frame chunks of an ended job: see Store::Compact. They only vanish from sight;
/// Purge removes them.
absl::StatusOr<JobOwner> Compact(Database& database, const std::string& name);

}  // namespace contact
