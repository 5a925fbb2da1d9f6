#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/read/artifact_plan.h"
#include "storage/store.h"

namespace contact {

class ArtifactMaker;
class Executor;

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
