#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/changes.h"
#include "storage/postgres/connection.h"
#include "storage/records.h"

namespace contact::postgres {

/// The statements of the calls of Store, and what their answers mean. The functions they call are
/// in schema.cpp. Each may be sent again when its answer was lost: it is done once.

/// The columns of a job's row that HeaderOf and JobsOf read.
extern const char kHeader[];

/// Adds new events of the log of a job as arrays of kinds, codings, sizes, checksums and payloads,
/// and their bytes.
void AddEvents(const std::string& job, const std::vector<EventRow>& events, Parameters* parameters);

/// See Store::Create.
Statement CreateJob(const JobInsert& job);
absl::StatusOr<StoredJob> Created(const Rows& rows, const std::string& name);

/// See Store::Update. After a change the second column is the first event appended, and the third
/// the tenant of the job.
Statement ChangeJob(const JobChange& change, std::uint64_t epoch);
absl::StatusOr<std::uint64_t> Changed(const Rows& rows, const std::string& name);

/// See Store::RequestCancel.
Statement RequestCancel(const std::string& name);
absl::StatusOr<bool> Done(const Rows& rows, const std::string& name);

/// See Store::Remark. After a change the fifth column is the state of the job.
Statement RemarkJob(const JobRemark& remark);
absl::StatusOr<JobOwner> Remarked(const Rows& rows, const std::string& name);

/// See Store::Read and Store::ReadOf.
Statement ReadJob(const std::string& name, std::optional<std::string> tenant, JobPart part);
absl::StatusOr<StoredJob> JobOf(const Rows& rows, const std::string& name);

/// See Store::Owner.
Statement FindOwner(const std::string& tenant, const std::string& name);
absl::StatusOr<JobOwner> OwnerOf(const Rows& rows, const std::string& name,
                                 const std::string& tenant);

/// See Store::OwnerBytes; one number.
Statement SumBytes(const JobOwner& whose);

/// See Store::List.
Statement ListJobs(const JobQuery& query);
absl::StatusOr<JobPage> PageOf(const Rows& rows, int limit);

/// See Store::ListUnfinished.
Statement ListUnfinished();
absl::StatusOr<std::vector<StoredJob>> JobsOf(const Rows& rows);
/// The jobs of rows with the columns of read_job up to the checkpoint. Of one whose spec is damaged
/// only the header.
std::vector<StoredJob> ClaimedOf(const Rows& rows);

/// See Store::Sizes.
Statement ListSizes();
absl::StatusOr<std::vector<JobSize>> SizesOf(const Rows& rows);

/// See Store::ReadEvents.
Statement ReadEvents(const EventQuery& query);
absl::StatusOr<EventPage> EventsOf(const Rows& rows, const EventQuery& query);

/// See Store::Delete. A deletion that is sent again answers NOT_FOUND.
Statement RemoveJob(const std::string& name, const std::string& expected_uid);
absl::StatusOr<JobOwner> Removed(const Rows& rows, const std::string& name);

/// See Store::Compact.
Statement CompactJob(const std::string& name);
absl::StatusOr<JobOwner> Compacted(const Rows& rows, const std::string& name);

/// Removes some of the events that were given up; answers whether there is more.
Statement Purge();

/// Says that the store is used, together with others, while the connection stands. ABORTED: a
/// program wants it for itself, and has not left within a second; the server notices within that
/// time that a program is dead.
inline constexpr char kUseStore[] =
    "SET lock_timeout = '1s'; SELECT pg_advisory_lock_shared(1668247155); RESET lock_timeout";
/// As kUseStore, for one that wants the store for itself.
inline constexpr char kTakeStore[] =
    "SET lock_timeout = '1s'; SELECT pg_advisory_lock(1668247155); RESET lock_timeout";

}  // namespace contact::postgres
