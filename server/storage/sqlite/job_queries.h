#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "storage/records.h"

namespace contact {

class Database;

/// Operations that read the tables. SQL errors are thrown as SQLite::Exception.

/// See Store::Read.
absl::StatusOr<StoredJob> Read(Database& database, const std::string& name, JobPart part);
/// See Store::ReadOf.
absl::StatusOr<StoredJob> ReadOf(Database& database, const std::string& tenant,
                                 const std::string& name, JobPart part);
/// See Store::Owner.
absl::StatusOr<JobOwner> FindOwner(Database& database, const std::string& tenant,
                                   const std::string& name);
/// See Store::OwnerBytes.
std::int64_t OwnerBytes(Database& database, const JobOwner& whose);
/// See Store::List.
JobPage List(Database& database, const JobQuery& query);
/// See Store::ListUnfinished.
std::vector<StoredJob> ListUnfinished(Database& database);
/// See Store::Sizes.
std::vector<JobSize> Sizes(Database& database);
/// See Store::ReadEvents. Looks at 4096 events at most.
absl::StatusOr<EventPage> ReadEvents(Database& database, const EventQuery& query);

}  // namespace contact
