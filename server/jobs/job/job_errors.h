#pragma once

#include <absl/status/status.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "jobs/job/error.h"

namespace contact {

/// The errors of job_service.proto that concern whole calls.
Error Draining();
/// The deadline of the call has passed, or its caller has left.
Error TooLate();
Error QueueFull(int max_queued_jobs);
Error WatcherLimit(int max_watchers);
/// The watcher of `what` fell behind.
Error SlowWatcher(const std::string& what);
/// The store could not read `what` for a stream, which therefore ends.
Error Unreadable(const std::string& what);
/// The job of that name is not the one expected, but this one.
Error UidMismatch(const std::string& name, const std::string& uid);
/// Frame chunks before `oldest_sequence` were asked for, and have been dropped.
Error EventsCompacted(const std::string& name, std::uint64_t oldest_sequence);
/// The job has not ended.
Error NotEnded(const std::string& name);
Error NoArtifact(const std::string& name, const std::string& artifact);
/// `size`: bytes of the artifact; negative if not known.
Error OffsetOutOfRange(std::int64_t offset, std::int64_t size);
Error NoTrajectory(const std::string& name);
/// `most`: samples that would be possible.
Error SeriesTooLarge(std::size_t most);
/// What is stored of the job fails its checksum.
Error Damaged(const std::string& name);

/// What a failed operation of the store on the job `name` (may be empty) means for its caller.
Error ToError(const absl::Status& status, const std::string& name);

}  // namespace contact
