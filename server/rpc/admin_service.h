#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <memory>

#include "base/executor.h"
#include "contact/v1/admin_service.grpc.pb.h"
#include "jobs/job_manager.h"

namespace contact {

class BackupCall;

/// The calls of AdminService.
class AdminService final : public v1::AdminService::CallbackService {
 public:
  /// A client that takes nothing for `write_stall` is dropped.
  AdminService(JobManager& jobs, std::chrono::milliseconds write_stall)
      : jobs_(jobs), write_stall_(write_stall) {}

 private:
  grpc::ServerWriteReactor<v1::BackupChunk>* Backup(grpc::CallbackServerContext* context,
                                                    const v1::BackupRequest* request) override;
  grpc::Status Serve(BackupCall& call);

  JobManager& jobs_;
  const std::chrono::milliseconds write_stall_;
  std::atomic<bool> busy_ = false;  ///< A backup is being made.
  Executor executor_;               ///< Reads, hashes and waits, as gRPC's threads must not.
};

}  // namespace contact
