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
  enum class Kind { kCycles, kTrajectory, kCellTrajectory };
  StoredJob stored;  ///< With its result for kCycles, not merged.
  std::string artifact;
  std::int64_t offset = 0;
  Kind kind = Kind::kCycles;
  std::int32_t cell = 0;  ///< For kCellTrajectory.
};
/// ARTIFACT_NOT_FOUND, INVALID_STATE. Asks for a job read as a whole.
Result<ArtifactPlan> PlanArtifact(StoredJob stored, const v1::ReadArtifactRequest& request);

}  // namespace contact
