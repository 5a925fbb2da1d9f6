#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <stop_token>

#include "base/mutex.h"
#include "contact/v1/admin_service.pb.h"

namespace contact {

/// One Backup call. What it sends comes from a thread that may wait, which those of gRPC may not.
class BackupCall final : public grpc::ServerWriteReactor<v1::BackupChunk> {
 public:
  /// The call owns itself until gRPC is done with it.
  static std::shared_ptr<BackupCall> Make(grpc::CallbackServerContext* context);

  /// Stops when the client has left.
  std::stop_token gone() const { return gone_.get_token(); }

  /// Sends a chunk and waits until gRPC has taken it; drops the client if that takes longer than
  /// `stall`. False: nobody takes it.
  bool Send(const v1::BackupChunk& chunk, std::chrono::milliseconds stall);

  /// Ends the call. Must be called once, last.
  void End(const grpc::Status& status) { Finish(status); }

 private:
  explicit BackupCall(grpc::CallbackServerContext* context) : context_(context) {}

  void OnWriteDone(bool ok) override;
  void OnCancel() override { gone_.request_stop(); }
  void OnDone() override;

  grpc::CallbackServerContext* const context_;  // Valid until End.
  std::stop_source gone_;

  Mutex mutex_;
  std::condition_variable_any taken_;
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool written_ ABSL_GUARDED_BY(mutex_) = false;  // The last write reached gRPC.
  std::shared_ptr<BackupCall> self_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
