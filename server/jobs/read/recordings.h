#pragma once

#include <memory>

#include "base/executor.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/job/callback.h"
#include "jobs/log/stream_source.h"
#include "jobs/quota/places.h"
#include "jobs/read/few_at_once.h"
#include "storage/store.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// Answers requests for what jobs of the caller's tenant have recorded. Thread-safe; no call waits.
class Recordings {
 public:
  /// Store and executor outlive it. What takes long is done on the executor. `readers` are the
  /// places of those who read artifacts.
  Recordings(Store& store, Executor& executor, const ScenarioLimits& limits, Places readers)
      : store_(store), executor_(executor), limits_(limits), readers_(std::move(readers)) {}

  /// The recorded trajectory of a job, decimated to what the request allows.
  void GetSeries(const Principal& caller, const v1::GetSeriesRequest& request,
                 Callback<v1::Series> done, Abandoned abandoned = {});

  /// Opens an artifact of an ended job. The source must not outlive the store.
  using Artifact = std::unique_ptr<StreamSource<v1::ReadArtifactResponse>>;
  void ReadArtifact(const Principal& caller, const v1::ReadArtifactRequest& request, Wake wake,
                    Callback<Artifact> done);

 private:
  Store& store_;
  Executor& executor_;
  const ScenarioLimits limits_;
  const Places readers_;
  /// Large series are made two at a time: one is decoded while the store reads for the other.
  FewAtOnce large_series_{2};
  /// So are artifacts: ten thousand readers must not hold up the store for others.
  FewAtOnce artifacts_{2};
};

}  // namespace contact
