#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job_manager.h"
#include "rpc/stream/stream_reactor.h"
#include "rpc/stream/watch_loop.h"
#include "rpc/stream/watch_message.h"

namespace contact {

/// One WatchJob call: a cursor over the log of a job. Its messages are composed of events that are
/// serialised once for all watchers.
class WatchReactor final : public StreamReactor<grpc::ByteBuffer> {
 public:
  /// Begins the watch. The reactor owns itself until gRPC is done with it. `request` is a
  /// serialised WatchJobRequest.
  static WatchReactor* Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                             grpc::CallbackServerContext* context, const grpc::ByteBuffer& request,
                             std::chrono::milliseconds write_stall);

 private:
  WatchReactor(grpc::CallbackServerContext* context, const std::string& name,
               std::chrono::milliseconds write_stall, std::shared_ptr<StreamMetrics> metrics);

  bool Next(grpc::ByteBuffer* out) override;
  bool IsDue(std::chrono::steady_clock::time_point now) const override;
  bool Write(const std::vector<LogRecord>& records, grpc::ByteBuffer* out);

  // Guarded by the mutex of the stream.
  const std::string name_;
  JobManager::Watched watched_;                      // Without cursor until opened.
  std::optional<v1::Job> snapshot_;                  // Not sent yet.
  std::chrono::steady_clock::time_point last_told_;  // When a place to resume from was sent.
};

}  // namespace contact
