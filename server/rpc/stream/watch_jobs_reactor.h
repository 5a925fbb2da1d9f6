#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <utility>

#include "contact/v1/job_service.pb.h"
#include "jobs/job_manager.h"
#include "rpc/stream/stream_reactor.h"
#include "rpc/stream/watch_loop.h"

namespace contact {

/// One WatchJobs call.
class WatchJobsReactor final : public StreamReactor<v1::WatchJobsResponse> {
 public:
  /// Begins the watch. The reactor owns itself until gRPC is done with it.
  static WatchJobsReactor* Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                 grpc::CallbackServerContext* context,
                                 const v1::WatchJobsRequest& request,
                                 std::chrono::milliseconds write_stall);

 private:
  WatchJobsReactor(grpc::CallbackServerContext* context, std::chrono::milliseconds write_stall,
                   std::shared_ptr<StreamMetrics> metrics)
      : StreamReactor("*", context, write_stall, std::move(metrics)) {}

  bool Next(v1::WatchJobsResponse* out) override;
  bool IsDue(std::chrono::steady_clock::time_point now) const override;

  JobManager::WatchedJobs watched_;  // Guarded by the mutex of the stream.
};

}  // namespace contact
