#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact {

/// Why a store refuses a call: the same status and the same words of every engine.

/// Payload of a status: the uid of the job that was found in place of the one expected.
inline constexpr char kUidPayload[] = "contact/uid";

/// Payloads of a RESOURCE_EXHAUSTED status of Store::Create: what there is of something limited.
inline constexpr char kOwnerBytesPayload[] = "contact/owner_bytes";  ///< Bytes of the owner's jobs.
inline constexpr char kOwnerJobsPayload[] = "contact/owner_jobs";    ///< His unfinished jobs.
inline constexpr char kOwnerCellsPayload[] = "contact/owner_cells";  ///< Their cells.
inline constexpr char kWaitingPayload[] = "contact/waiting";         ///< Jobs that wait.

/// NOT_FOUND, for a job with this name.
absl::Status NoSuchJob(const std::string& name);
/// DATA_LOSS, for a job that is damaged.
absl::Status FailsChecksum(const std::string& name);
/// ABORTED, with the uid of `job`, which is not the one expected, as the payload kUidPayload.
absl::Status OtherJob(const v1::Job& job);
/// ABORTED: the job has another epoch than the change names.
absl::Status HasOtherOwner(const std::string& name);
/// FAILED_PRECONDITION, for what is done to ended jobs only.
absl::Status HasNotEnded(const std::string& name);
/// ALREADY_EXISTS: the request id was used to ask for another job, `name`.
absl::Status RequestIdWasUsed(const std::string& name);
/// RESOURCE_EXHAUSTED, see NewJob::may_create.
absl::Status MayNotBeNew();
/// RESOURCE_EXHAUSTED: there is so much of something limited; `payload` names it.
absl::Status TooMuch(const char* payload, std::int64_t has);

}  // namespace contact
