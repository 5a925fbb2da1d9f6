#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <string>

#include "storage/changes.h"
#include "storage/records.h"

namespace contact {

class Database;

/// Operations that change the tables, each inside the transaction of its caller. One that returns
/// an error has changed nothing. SQL errors are thrown as SQLite::Exception.

/// Stores a job, or finds the one that the same request has made: see Store::Create.
absl::StatusOr<StoredJob> Insert(Database& database, const JobInsert& insert);

/// Returns the sequence of the first event appended: see Store::Update.
absl::StatusOr<std::uint64_t> Change(Database& database, const JobChange& change,
                                     std::uint64_t epoch);

/// Remembers that a user wants the job cancelled: see Store::RequestCancel.
absl::Status MarkCancelRequested(Database& database, const std::string& name);

/// Replaces labels or note of a job: see Store::Remark.
absl::StatusOr<JobOwner> Remark(Database& database, const JobRemark& remark);

/// Removes an ended job: see Store::Delete. Its events only vanish from sight; Purge removes them.
absl::StatusOr<JobOwner> Remove(Database& database, const std::string& name,
                                const std::string& expected_uid);

/// Gives up the frame chunks of an ended job: see Store::Compact. They only vanish from sight;
/// Purge removes them.
absl::StatusOr<JobOwner> Compact(Database& database, const std::string& name);

}  // namespace contact
