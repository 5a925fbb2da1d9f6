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

/// The answer is read by ClaimedOf. What a lost answer gave away is in the answer of the next Beat.
Statement Claim(const JobClaim& claim);

Statement Leave(const std::string& worker);

Statement Lend(const std::string& worker, const std::string& job, const std::vector<Loan>& loans);
Statement SettleLoans(const std::string& worker, const std::string& job,
                      const std::vector<std::int64_t>& numbers, bool back);
absl::StatusOr<std::vector<LoanEnd>> LoanEndsOf(const Rows& rows);
Statement TakeLoan(const std::string& worker);
absl::StatusOr<std::optional<Loan>> LoanOf(const Rows& rows);
/// The answer is read by Changed.
Statement ReturnLoan(const std::string& worker, const Loan& loan, const LoanCounts& counts,
                     const JobChange& change);
Statement RefuseLoan(const std::string& worker, const Loan& loan);

Statement Count();
absl::StatusOr<Demand> DemandOf(const Rows& rows);

Statement CountOf(const JobOwner& whose);
absl::StatusOr<OwnerCounts> OwnerCountsOf(const Rows& rows);

Statement FindPositions(const std::vector<std::string>& names);
absl::StatusOr<std::vector<LogPosition>> PositionsOf(const Rows& rows);

/// The answer is the value.
Statement Keep(const std::string& name, const std::string& value, bool replace);

Statement FindMoved(std::uint64_t since);
absl::StatusOr<MovedJobs> MovedJobsOf(const Rows& rows);

}  // namespace contact::postgres
