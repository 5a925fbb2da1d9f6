#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/job_parts.h"
#include "storage/records.h"

namespace contact {

/// Changes with their messages serialised and compressed, as every engine stores them. Making them
/// takes long for frame chunks: not for an engine's thread.

/// A NewJob.
struct JobInsert {
  std::string name;
  /// What identifies the request among those of all tenants; empty: nothing does.
  std::string request_key;
  /// Whose the job is.
  JobOwner whose;
  /// A v1::Job::State.
  int state = 0;
  std::string uid;
  JobLabels labels;
  JobParts parts;
  std::vector<EventRow> events;
  /// See NewJob::may_create.
  bool may_create = true;
  /// See NewJob::max_owner_bytes.
  std::int64_t max_owner_bytes = 0;
  /// See NewJob::limits.
  UnfinishedLimits limits;
  /// See v1::Job.
  std::int64_t priority = 0;
  /// Of a sweep.
  std::int64_t cells = 0;
};
JobInsert ToInsert(const NewJob& job);
/// NewJob::request_id, of a job of this tenant; empty if the key is that of another.
std::string RequestIdOf(const std::string& request_key, const std::string& tenant);

/// A JobUpdate, without the epoch that it needs.
struct JobChange {
  std::string name;
  /// Differs from that of every other change. An engine that sends a change again, because the
  /// answer was lost, finds out by it whether it is done.
  std::uint64_t id = 0;
  /// See JobUpdate::take.
  bool take = false;
  /// A v1::Job::State; used with `parts` only.
  int state = 0;
  /// With an empty header the stored job stays as it is. The spec is never replaced.
  JobParts parts;
  std::vector<EventRow> events;
  std::optional<Checkpoint> checkpoint;
};
JobChange ToChange(const JobUpdate& update);
/// One change that does what `first` and then `last` do to the same job.
JobChange Joined(const JobChange& first, const JobChange& last);

/// Labels as a remark keeps them.
std::string BytesOf(const JobLabels& labels);

/// Bytes that events take in the store.
std::size_t BytesOf(const std::vector<EventRow>& events);

}  // namespace contact
