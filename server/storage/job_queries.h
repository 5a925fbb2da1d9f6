#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <string>
#include <vector>

#include "storage/records.h"

namespace contact {

class Database;

/// Operations that read the tables. SQL errors are thrown as SQLite::Exception.

absl::Status NoSuchJob(const std::string& name);
/// DATA_LOSS.
absl::Status FailsChecksum(const std::string& name);
/// ABORTED, with the uid that the job has.
absl::Status OtherJob(const v1::Job& job);

/// See the functions of Store with these names.
absl::StatusOr<StoredJob> Read(Database& database, const std::string& name, JobPart part);
JobPage List(Database& database, const JobQuery& query);
std::vector<StoredJob> ListUnfinished(Database& database);
std::vector<JobSize> Sizes(Database& database);
absl::StatusOr<EventPage> ReadEvents(Database& database, const EventQuery& query);

}  // namespace contact
