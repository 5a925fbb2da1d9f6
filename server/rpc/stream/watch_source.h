#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <memory>
#include <string>

#include "base/clock.h"
#include "jobs/job_manager.h"
#include "rpc/metrics/stream_metrics.h"
#include "rpc/stream/stream_source.h"

namespace contact {

/// The messages of one WatchJob call, as serialised WatchJobResponses: the snapshot, then the
/// events that the cursor of `watched` reads, in batches of up to 256 KiB, then a bookmark whenever
/// nothing else has told a sequence to resume from for `watched.bookmark_interval`. An event is
/// serialised once for all watchers.
///
/// `name` is the job's, for errors. `clock` and `metrics`, which counts left out events, outlive
/// the source.
std::unique_ptr<StreamSource<grpc::ByteBuffer>> MakeWatchSource(JobManager::Watched watched,
                                                                std::string name,
                                                                const Clock& clock,
                                                                StreamMetrics& metrics);

}  // namespace contact
