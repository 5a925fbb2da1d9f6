#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>

#include "base/executor.h"
#include "contact/v1/admin_service.grpc.pb.h"
#include "rpc/call_starter.h"
#include "storage/store.h"

namespace contact {

/// The calls of the contract's AdminService. Handlers never wait.
class AdminService final : public v1::AdminService::CallbackService {
 public:
  /// The store and `calls` outlive the service.
  AdminService(Store& store, CallStarter& calls) : store_(store), calls_(calls) {}

 private:
  /// Copies the store, and sends the copy. BACKUP_RUNNING while another backup is made or sent.
  grpc::ServerWriteReactor<v1::BackupChunk>* Backup(grpc::CallbackServerContext* context,
                                                    const v1::BackupRequest* request) override;

  Store& store_;
  CallStarter& calls_;
  /// True while a backup is being made or sent.
  std::atomic<bool> busy_ = false;
  /// Reads and hashes the file that is sent.
  Executor executor_{"backup"};
};

}  // namespace contact
