#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>

#include "base/executor.h"
#include "contact/v1/admin_service.grpc.pb.h"
#include "jobs/job_manager.h"
#include "rpc/call_starter.h"

namespace contact {

/// The calls of the contract's AdminService. Handlers never wait.
class AdminService final : public v1::AdminService::CallbackService {
 public:
  /// The manager and `calls` outlive the service.
  AdminService(JobManager& jobs, CallStarter& calls) : jobs_(jobs), calls_(calls) {}

 private:
  grpc::ServerWriteReactor<v1::BackupChunk>* Backup(grpc::CallbackServerContext* context,
                                                    const v1::BackupRequest* request) override;

  JobManager& jobs_;
  CallStarter& calls_;
  std::atomic<bool> busy_ = false;  ///< A backup is being made or sent.
  Executor executor_{"backup"};     ///< Reads and hashes the file that is sent.
};

}  // namespace contact
