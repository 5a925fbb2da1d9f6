#include "jobs/job/job_errors.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "storage/records.h"

namespace contact {
namespace {

constexpr std::chrono::milliseconds kRetryAfter{1000};

}  // namespace

Error Draining() {
  return {.code = absl::StatusCode::kUnavailable,
          .reason = "SERVER_DRAINING",
          .message = "the server is shutting down",
          .retry_after = kRetryAfter};
}

Error TooLate() {
  return {.code = absl::StatusCode::kDeadlineExceeded,
          .reason = "DEADLINE_EXCEEDED",
          .message = "the deadline of the call passed before its turn came"};
}

Error QueueFull(int max_queued_jobs) {
  return {.code = absl::StatusCode::kResourceExhausted,
          .reason = "QUEUE_FULL",
          .message = fmt::format("{} jobs are waiting already", max_queued_jobs),
          .retry_after = kRetryAfter};
}

Error WatcherLimit(int max_watchers) {
  return {.code = absl::StatusCode::kResourceExhausted,
          .reason = "WATCHER_LIMIT",
          .message = fmt::format("there are {} watchers already", max_watchers),
          .retry_after = kRetryAfter};
}

Error SlowWatcher(const std::string& what) {
  return {.code = absl::StatusCode::kResourceExhausted,
          .reason = "SLOW_WATCHER",
          .message = fmt::format("the watcher of {} fell behind; watch again, or take less", what),
          .retry_after = kRetryAfter};
}

Error Unreadable(const std::string& what) {
  return {.code = absl::StatusCode::kUnavailable,
          .reason = "STORE_FAILED",
          .message = fmt::format("{} could not be read from the store; watch again", what),
          .retry_after = kRetryAfter};
}

Error UidMismatch(const std::string& name, const std::string& uid) {
  return {.code = absl::StatusCode::kFailedPrecondition,
          .reason = "UID_MISMATCH",
          .message = fmt::format("{} is another job than the one expected", name),
          .metadata = {{"name", name}, {"uid", uid}}};
}

Error EventsCompacted(const std::string& name, std::uint64_t oldest_sequence) {
  return {.code = absl::StatusCode::kOutOfRange,
          .reason = "EVENTS_COMPACTED",
          .message = fmt::format("the trajectory of {} was dropped some time after its end, as the "
                                 "server is set; ledger, result and other events are there",
                                 name),
          .metadata = {{"name", name}, {"oldest_sequence", fmt::format("{}", oldest_sequence)}}};
}

Error NotEnded(const std::string& name) {
  return {.code = absl::StatusCode::kFailedPrecondition,
          .reason = "INVALID_STATE",
          .message = fmt::format("{} has not ended", name),
          .metadata = {{"name", name}}};
}

Error NoArtifact(const std::string& name, const std::string& artifact) {
  return {.code = absl::StatusCode::kNotFound,
          .reason = "ARTIFACT_NOT_FOUND",
          .message = fmt::format("{} has no artifact '{}'", name, artifact.substr(0, 64)),
          .metadata = {{"name", name}}};
}

Error OffsetOutOfRange(std::int64_t offset, std::int64_t size) {
  Error error{
      .code = absl::StatusCode::kOutOfRange,
      .reason = "OFFSET_OUT_OF_RANGE",
      .message = fmt::format("offset is {}; must be in [0, the size of the artifact]", offset)};
  if (size >= 0) error.metadata["size_bytes"] = fmt::format("{}", size);
  return error;
}

Error NoTrajectory(const std::string& name) {
  return {.code = absl::StatusCode::kFailedPrecondition,
          .reason = "NO_TRAJECTORY",
          .message = name + " records no trajectory",
          .metadata = {{"name", name}}};
}

Error SeriesTooLarge(std::size_t most) {
  return {.code = absl::StatusCode::kOutOfRange,
          .reason = "SERIES_TOO_LARGE",
          .message = fmt::format("there are more than the {} samples that may be answered; ask for "
                                 "fewer channels, a shorter time range, or MINMAX",
                                 most)};
}

Error Damaged(const std::string& name) {
  return ToError(absl::DataLossError(name + " fails its checksum in the store"), name);
}

Error ToError(const absl::Status& status, const std::string& name) {
  if (const auto uid = status.GetPayload(kUidPayload)) return UidMismatch(name, std::string(*uid));
  Error error{.code = status.code(), .message = std::string(status.message())};
  if (!name.empty()) error.metadata["name"] = name;
  switch (status.code()) {
    case absl::StatusCode::kNotFound:
      error.reason = "JOB_NOT_FOUND";
      return error;
    case absl::StatusCode::kAlreadyExists:
      error.reason = "REQUEST_ID_REUSED";
      return error;
    case absl::StatusCode::kFailedPrecondition:
      error.reason = "INVALID_STATE";
      return error;
    case absl::StatusCode::kResourceExhausted:
      error.reason = "STORE_FULL";
      error.retry_after = kRetryAfter;
      break;
    case absl::StatusCode::kDataLoss:
      error.reason = "DATA_LOSS";
      break;
    default:
      error.code = absl::StatusCode::kUnavailable;
      error.reason = "STORE_FAILED";
  }
  spdlog::error("job={} reason={} message={}", name, error.reason, error.message);
  return error;
}

}  // namespace contact
