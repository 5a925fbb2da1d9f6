#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/error.h"
#include "storage/store.h"

namespace contact {

class ArtifactMaker;
class Executor;

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

/// Reads an artifact: it is made from the log piece by piece, on the thread that checks scenarios,
/// no faster than it is read. Not thread-safe: one reader. Destroying it ends the making.
class ArtifactReader {
 public:
  enum class Next {
    kData,    ///< `out` holds a chunk.
    kWait,    ///< Nothing now; `wake` will be called.
    kEnd,     ///< `out` holds the artifact with size and SHA-256.
    kFailed,  ///< See error().
  };

  /// `wake` as for JobManager::Watch. `readers` counts the readers alive; the caller has counted
  /// this one already. Store and executor outlive it.
  ArtifactReader(Store& store, Executor& executor, ArtifactPlan plan, std::function<void()> wake,
                 std::shared_ptr<std::atomic<int>> readers);
  ~ArtifactReader();
  ArtifactReader(const ArtifactReader&) = delete;
  ArtifactReader& operator=(const ArtifactReader&) = delete;

  /// Never blocks.
  Next Read(v1::ReadArtifactResponse* out);
  const Error& error() const { return error_; }

 private:
  const std::shared_ptr<std::atomic<int>> readers_;
  const std::shared_ptr<ArtifactMaker> maker_;
  Error error_;
};

}  // namespace contact
