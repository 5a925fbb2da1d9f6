#include "jobs/job/errors.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/spelling.h"
#include "storage/records.h"
#include "storage/refusals.h"

namespace contact {
namespace {

using enum absl::StatusCode;

constexpr std::chrono::milliseconds kSoon{1000};
constexpr std::chrono::milliseconds kNever{0};

constexpr std::array kReasons = std::to_array<ReasonInfo>({
    {Reason::kFieldInvalid, "FIELD_INVALID", kInvalidArgument, kNever, ""},
    {Reason::kScenarioInvalid, "SCENARIO_INVALID", kInvalidArgument, kNever, ""},
    {Reason::kRequestIdReused, "REQUEST_ID_REUSED", kAlreadyExists, kNever, ""},
    {Reason::kJobNotFound, "JOB_NOT_FOUND", kNotFound, kNever, ""},
    {Reason::kArtifactNotFound, "ARTIFACT_NOT_FOUND", kNotFound, kNever, ""},
    {Reason::kInvalidState, "INVALID_STATE", kFailedPrecondition, kNever, ""},
    {Reason::kUidMismatch, "UID_MISMATCH", kFailedPrecondition, kNever, ""},
    {Reason::kNoTrajectory, "NO_TRAJECTORY", kFailedPrecondition, kNever, ""},
    {Reason::kOffsetOutOfRange, "OFFSET_OUT_OF_RANGE", kOutOfRange, kNever, ""},
    {Reason::kSeriesTooLarge, "SERIES_TOO_LARGE", kOutOfRange, kNever, ""},
    {Reason::kEventsCompacted, "EVENTS_COMPACTED", kOutOfRange, kNever, ""},
    {Reason::kQueueFull, "QUEUE_FULL", kResourceExhausted, kSoon, ""},
    {Reason::kWatcherLimit, "WATCHER_LIMIT", kResourceExhausted, kSoon, ""},
    {Reason::kSlowWatcher, "SLOW_WATCHER", kResourceExhausted, kSoon, ""},
    {Reason::kRateLimited, "RATE_LIMITED", kResourceExhausted, kSoon, ""},
    {Reason::kQuotaExceeded, "QUOTA_EXCEEDED", kResourceExhausted, kSoon, ""},
    {Reason::kMetadataTooLarge, "METADATA_TOO_LARGE", kResourceExhausted, kNever, ""},
    {Reason::kBackupRunning, "BACKUP_RUNNING", kResourceExhausted, kSoon,
     "another backup is being made"},
    {Reason::kStoreFull, "STORE_FULL", kResourceExhausted, kSoon, ""},
    {Reason::kStoreFailed, "STORE_FAILED", kUnavailable, kSoon, ""},
    {Reason::kDataLoss, "DATA_LOSS", kDataLoss, kNever, ""},
    {Reason::kServerDraining, "SERVER_DRAINING", kUnavailable, kSoon,
     "the server is shutting down"},
    {Reason::kDeadlineExceeded, "DEADLINE_EXCEEDED", kDeadlineExceeded, kNever,
     "the deadline of the call passed before its turn came"},
    {Reason::kUnauthenticated, "UNAUTHENTICATED", kUnauthenticated, kNever, ""},
    {Reason::kPermissionDenied, "PERMISSION_DENIED", kPermissionDenied, kNever, ""},
    {Reason::kAuditFailed, "AUDIT_FAILED", kUnavailable, kNever,
     "the call cannot be written to the audit log"},
});

constexpr bool StandInOrder(std::span<const ReasonInfo> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].reason != static_cast<Reason>(i)) return false;
  }
  return true;
}
static_assert(StandInOrder(kReasons));

// Why an operation of the store failed with this code.
Reason ReasonOf(absl::StatusCode code) {
  constexpr std::array kOfStore = {Reason::kJobNotFound, Reason::kRequestIdReused,
                                   Reason::kInvalidState, Reason::kStoreFull, Reason::kDataLoss};
  const auto found =
      std::ranges::find(kOfStore, code, [](Reason reason) { return InfoOf(reason).code; });
  return found == kOfStore.end() ? Reason::kStoreFailed : *found;
}

bool IsOfTheDisk(Reason reason) {
  return reason == Reason::kStoreFull || reason == Reason::kDataLoss ||
         reason == Reason::kStoreFailed;
}

}  // namespace

std::span<const ReasonInfo> Reasons() { return kReasons; }

const ReasonInfo& InfoOf(Reason reason) { return kReasons.at(static_cast<std::size_t>(reason)); }

Error MakeError(Reason reason, std::string message) {
  const ReasonInfo& info = InfoOf(reason);
  return {.code = info.code,
          .reason = info.name,
          .message = message.empty() ? info.message : std::move(message),
          .retry_after = info.retry_after};
}

Error JobError(Reason reason, const std::string& name, const std::string& what) {
  const std::string shown = Shortened(name);  // It may be what a client sent.
  Error error = MakeError(reason, shown + ' ' + what);
  error.metadata["name"] = shown;
  return error;
}

Error Invalid(std::vector<Violation> of_request, std::vector<Violation> of_spec) {
  Error error = MakeError(of_spec.empty() ? Reason::kFieldInvalid : Reason::kScenarioInvalid);
  error.violations = std::move(of_request);
  error.violations.insert(error.violations.end(), of_spec.begin(), of_spec.end());
  const Violation& first = error.violations.front();
  error.message = first.field + ": " + first.description;
  return error;
}

Error QueueFull(int max_queued_jobs) {
  return MakeError(Reason::kQueueFull,
                   Count(max_queued_jobs, "job is", "jobs are") + " waiting already");
}

Error DiskFull(int used_percent, int max_percent, std::int64_t free) {
  return MakeError(
      Reason::kStoreFull,
      fmt::format("the disk of the store is {} % full, {} MB are left; new jobs are "
                  "accepted up to {} %: delete jobs, or have the server's disk cleared",
                  used_percent, free / 1'000'000, max_percent));
}

Error WatcherLimit(int max_watchers) {
  return MakeError(Reason::kWatcherLimit,
                   Count(max_watchers, "watcher is", "watchers are") + " there already");
}

Error SlowWatcher(const std::string& what) {
  return MakeError(Reason::kSlowWatcher,
                   fmt::format("the watcher of {} fell behind; watch again, or take less", what));
}

Error Unreadable(const std::string& what) {
  return MakeError(Reason::kStoreFailed, what + " could not be read from the store; watch again");
}

Error UidMismatch(const std::string& name, const std::string& uid) {
  Error error = JobError(Reason::kUidMismatch, name, "is another job than the one expected");
  error.metadata["uid"] = uid;
  return error;
}

Error Denied(const std::string& permission, const std::string& message) {
  Error error = MakeError(Reason::kPermissionDenied, message);
  error.metadata["permission"] = permission;
  return error;
}

Error NotYours(const std::string& name, const std::string& owner) {
  Error error = Denied("operator",
                       fmt::format("{} belongs to {}; that needs the role operator", name, owner));
  error.metadata["name"] = name;
  return error;
}

Error EventsCompacted(const std::string& name, std::uint64_t oldest_sequence) {
  Error error = MakeError(Reason::kEventsCompacted,
                          fmt::format("the trajectory of {} was dropped some time after its end, "
                                      "as the server is set; ledger, result and other events are "
                                      "there",
                                      name));
  error.metadata["name"] = name;
  error.metadata["oldest_sequence"] = fmt::format("{}", oldest_sequence);
  return error;
}

Error NoArtifact(const std::string& name, const std::string& artifact) {
  return JobError(Reason::kArtifactNotFound, name,
                  fmt::format("has no artifact {}", Quoted(artifact)));
}

Error OffsetOutOfRange(std::int64_t offset, std::int64_t size) {
  Error error =
      MakeError(Reason::kOffsetOutOfRange,
                fmt::format("offset is {}; must be in [0, the size of the artifact]", offset));
  if (size >= 0) error.metadata["size_bytes"] = fmt::format("{}", size);
  return error;
}

Error SeriesTooLarge(std::size_t most) {
  return MakeError(Reason::kSeriesTooLarge,
                   fmt::format("there are more than the {} samples that may be answered; ask for "
                               "fewer channels, a shorter time range, or MINMAX",
                               most));
}

Error Damaged(const std::string& name) {
  return ToError(absl::DataLossError(name + " fails its checksum in the store"), name);
}

Error ToError(const absl::Status& status, const std::string& name) {
  if (const auto uid = status.GetPayload(kUidPayload)) return UidMismatch(name, std::string(*uid));
  const Reason reason = ReasonOf(status.code());
  Error error = MakeError(reason, std::string(status.message()));
  if (!name.empty()) error.metadata["name"] = Shortened(name);
  if (IsOfTheDisk(reason)) {
    spdlog::error("job={} reason={} message={}", name, error.reason, error.message);
  }
  return error;
}

}  // namespace contact
