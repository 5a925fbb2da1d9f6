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

/// One ReadArtifact call.
class ArtifactReactor final : public StreamReactor<v1::ReadArtifactResponse> {
 public:
  /// Begins the reading. The reactor owns itself until gRPC is done with it.
  static ArtifactReactor* Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                grpc::CallbackServerContext* context,
                                const v1::ReadArtifactRequest& request,
                                std::chrono::milliseconds write_stall);

 private:
  ArtifactReactor(grpc::CallbackServerContext* context, const v1::ReadArtifactRequest& request,
                  std::chrono::milliseconds write_stall, std::shared_ptr<StreamMetrics> metrics)
      : StreamReactor(request.name(), context, write_stall, std::move(metrics)) {}

  bool Next(v1::ReadArtifactResponse* out) override;
  bool IsDue(std::chrono::steady_clock::time_point) const override { return false; }

  // Guarded by the mutex of the stream.
  std::unique_ptr<ArtifactReader> reader_;  // None until opened, and after the last chunk.
};

}  // namespace contact
