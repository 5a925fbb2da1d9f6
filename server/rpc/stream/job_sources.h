#pragma once

#include <memory>

#include "base/clock.h"
#include "contact/v1/job_service.pb.h"
#include "jobs/job_manager.h"
#include "rpc/stream/stream_source.h"

namespace contact {

/// The messages of one WatchJobs call: what the cursor reads, and a message without jobs whenever
/// nothing was sent for `watched.bookmark_interval`. `clock` outlives the source.
std::unique_ptr<StreamSource<v1::WatchJobsResponse>> MakeJobsSource(JobManager::WatchedJobs watched,
                                                                    const Clock& clock);

/// The messages of one ReadArtifact call.
std::unique_ptr<StreamSource<v1::ReadArtifactResponse>> MakeArtifactSource(
    std::unique_ptr<ArtifactReader> reader);

}  // namespace contact
