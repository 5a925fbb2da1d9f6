#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <memory>

#include "base/clock.h"
#include "jobs/log/stream_source.h"
#include "jobs/watches.h"
#include "rpc/metrics/stream_metrics.h"

namespace contact {

/// The messages of one WatchJob call, as serialised WatchJobResponses: the snapshot, then the
/// events that the cursor of `watched` reads, in batches of MessageBytes, then a bookmark whenever
/// nothing else has told a sequence to resume from for `watched.bookmark_interval`. An event is
/// serialised once for all watchers.
///
/// `clock` and `metrics`, which counts left out events, outlive the source.
std::unique_ptr<StreamSource<grpc::ByteBuffer>> MakeWatchSource(WatchedJob watched,
                                                                const Clock& clock,
                                                                StreamMetrics& metrics);

}  // namespace contact
