#pragma once

#include <cstdint>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "storage/records.h"

namespace contact {

/// Names the artifacts that an ended job has.
void AddArtifacts(v1::Job* job);

/// An artifact that is to be made.
struct ArtifactPlan {
  /// What the artifact is made of.
  enum class Kind { kCycles, kGroups, kTrajectory, kCellTrajectory };
  /// The job; for kCycles and kGroups with its result, which is not merged. For others its name and
  /// last sequence alone, because a reader may keep it for long.
  StoredJob stored;
  /// Its name.
  std::string artifact;
  /// Bytes that the reader has already.
  std::int64_t offset = 0;
  Kind kind = Kind::kCycles;
  /// The cell of the sweep; only for kCellTrajectory.
  std::int32_t cell = 0;
};
/// Plans the artifact that is asked for; ARTIFACT_NOT_FOUND or INVALID_STATE if the job does not
/// have it. `stored` is read with JobPart::kAll.
Result<ArtifactPlan> PlanArtifact(StoredJob stored, const v1::ReadArtifactRequest& request);

}  // namespace contact
