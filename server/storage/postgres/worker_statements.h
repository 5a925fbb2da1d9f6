#pragma once

#include <absl/status/statusor.h>

#include <vector>

#include "storage/postgres/connection.h"
#include "storage/shared_store.h"

namespace contact::postgres {

/// The statements of the calls of SharedStore, and what their answers mean. The functions they call
/// are in worker_schema.cpp. Each may be sent again when its answer was lost.

Statement Beat(const WorkerProcess& worker);
absl::StatusOr<std::vector<HeldJob>> HeldJobsOf(const Rows& rows);

/// The answer is read by JobsOf. What a lost answer gave away is in the answer of the next Beat.
Statement Claim(const JobClaim& claim);

Statement Leave(const std::string& worker);

Statement Count();
absl::StatusOr<Demand> DemandOf(const Rows& rows);

Statement CountOf(const JobOwner& whose);
absl::StatusOr<OwnerCounts> OwnerCountsOf(const Rows& rows);

Statement FindPositions(const std::vector<std::string>& names);
absl::StatusOr<std::vector<LogPosition>> PositionsOf(const Rows& rows);

Statement FindMoved(std::uint64_t since);
absl::StatusOr<MovedJobs> MovedJobsOf(const Rows& rows);

}  // namespace contact::postgres
