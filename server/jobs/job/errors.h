#pragma once

#include <absl/status/status.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wire/rules/violation.h"

namespace contact {

/// Why a call can fail. Names, codes and meaning are part of the contract: see job_service.proto
/// and admin_service.proto.
enum class Reason {
  kFieldInvalid,
  kScenarioInvalid,
  kRequestIdReused,
  kJobNotFound,
  kArtifactNotFound,
  kInvalidState,
  kUidMismatch,
  kNoTrajectory,
  kOffsetOutOfRange,
  kSeriesTooLarge,
  kEventsCompacted,
  kQueueFull,
  kWatcherLimit,
  kSlowWatcher,
  kRateLimited,
  kQuotaExceeded,
  kMetadataTooLarge,
  kBackupRunning,
  kStoreFull,
  kStoreFailed,
  kDataLoss,
  kServerDraining,
  kDeadlineExceeded,
  kUnauthenticated,
  kPermissionDenied,
  kAuditFailed,
};

/// What all errors of one reason have in common.
struct ReasonInfo {
  Reason reason;
  /// Its name for programs, in UPPER_SNAKE_CASE.
  const char* name;
  /// The canonical code; gRPC has the same numbers.
  absl::StatusCode code;
  /// Time after which the caller may try again; 0: trying again is no use.
  std::chrono::milliseconds retry_after;
  /// The words for an error that has none of its own; may be empty.
  const char* message;
};

/// The table of all reasons, in the order of the enumeration. The only place with their names.
std::span<const ReasonInfo> Reasons();

/// The row of the table for this reason.
const ReasonInfo& InfoOf(Reason reason);

/// Why a call failed, as the contract tells it: canonical code, reason for programs, words for
/// people. rpc/ turns it into a gRPC status with details.
struct Error {
  absl::StatusCode code = absl::StatusCode::kInternal;
  /// Name of the reason, see ReasonInfo.
  std::string reason = {};
  /// The words for people; without a full stop.
  std::string message = {};
  /// Rules that the request breaks; they become BadRequest.
  std::vector<Violation> violations = {};
  /// Facts for programs; they become the metadata of ErrorInfo.
  std::map<std::string, std::string> metadata = {};
  /// As in ReasonInfo; above 0 it becomes RetryInfo.
  std::chrono::milliseconds retry_after{0};
};

/// A value, or the error that explains why there is none.
template <class T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)
  /// True if there is a value.
  bool ok() const { return std::holds_alternative<T>(state_); }
  /// The value. Only if ok().
  T& value() { return std::get<T>(state_); }
  const T& value() const { return std::get<T>(state_); }
  /// Why there is no value. Only if not ok().
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// An error with code and retry delay of its reason, and its words unless `message` has others.
Error MakeError(Reason reason, std::string message = {});

/// An error of the job called `name`, with the words "`name` `what`", such as "jobs/a was deleted".
Error JobError(Reason reason, const std::string& name, const std::string& what);

/// The error of a request that breaks rules of the contract: kScenarioInvalid if it breaks some of
/// those for scenarios and sweeps, else kFieldInvalid. Lists all violations; at least one is given.
Error Invalid(std::vector<Violation> of_request, std::vector<Violation> of_spec = {});

/// As many jobs wait as may (kQueueFull).
Error QueueFull(int max_queued_jobs);
/// The disk of the store is so full that no job is accepted (kStoreFull). `free`: bytes left.
Error DiskFull(int used_percent, int max_percent, std::int64_t free);
/// As many streams are open as may be (kWatcherLimit).
Error WatcherLimit(int max_watchers);
/// The watcher of `what` was too slow to keep up with it (kSlowWatcher).
Error SlowWatcher(const std::string& what);
/// The store could not read `what` for a stream, which therefore ends (kStoreFailed). With a retry
/// delay.
Error Unreadable(const std::string& what);
/// The job called `name` has `uid`, which is not the one expected (kUidMismatch).
Error UidMismatch(const std::string& name, const std::string& uid);
/// The caller lacks a permission, which `permission` names (kPermissionDenied).
Error Denied(const std::string& permission, const std::string& message);
/// The job belongs to another principal of the tenant, and the caller may change own jobs only
/// (kPermissionDenied).
Error NotYours(const std::string& name, const std::string& owner);
/// Frame chunks before `oldest_sequence` were asked for, and have been dropped (kEventsCompacted).
Error EventsCompacted(const std::string& name, std::uint64_t oldest_sequence);
/// The job has no such artifact (kArtifactNotFound).
Error NoArtifact(const std::string& name, const std::string& artifact);
/// An artifact cannot be read from this offset (kOffsetOutOfRange). `size`: bytes of the artifact;
/// negative if not known.
Error OffsetOutOfRange(std::int64_t offset, std::int64_t size);
/// More samples were selected than the `most` that an answer can have (kSeriesTooLarge).
Error SeriesTooLarge(std::size_t most);
/// What is stored of the job fails its checksum (kDataLoss). Writes a line to the log.
Error Damaged(const std::string& name);

/// What a failed operation of the store on the job `name` (may be empty) means for its caller.
/// Failures of the disk write a line to the log.
Error ToError(const absl::Status& status, const std::string& name);

}  // namespace contact
