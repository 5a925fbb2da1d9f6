#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job_manager.h"
#include "rpc/watch_loop.h"

namespace contact {

/// One WatchJob call: a cursor over the log of a job and at most one message under way.
///
/// Log, gRPC and clock all enter through Step, which under the one mutex makes the change and, if
/// no operation is under way, chooses the next one; it is started after the mutex is released.
/// So there is never a second write, never a Finish beside a write, and exactly one Finish.
class WatchReactor final : public grpc::ServerWriteReactor<v1::WatchJobResponse> {
 public:
  /// Begins the watch. The reactor owns itself until gRPC is done with it.
  static WatchReactor* Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                             grpc::CallbackServerContext* context,
                             const v1::WatchJobRequest& request,
                             std::chrono::milliseconds write_stall);

  /// Looks whether there is something to send.
  void Poke();

  /// Ends the watch with SERVER_DRAINING, after the write under way.
  void Drain();

  /// Sends a bookmark if one is due; ends the call if its write takes longer than `write_stall`.
  void Tick(std::chrono::steady_clock::time_point now);

 private:
  enum class State { kIdle, kWriting, kFinishing, kDone };

  WatchReactor(grpc::CallbackServerContext* context, const v1::WatchJobRequest& request,
               std::chrono::milliseconds write_stall);

  void Open(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
            const v1::WatchJobRequest& request);
  void Opened(Result<JobManager::Watched> result);

  template <class Change>
  void Step(Change change);
  State Choose();
  bool NextMessage();
  bool Bookmark();
  void EndWith(const grpc::Status& status);
  std::shared_ptr<WatchReactor> Self();

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

  const std::string name_;
  const std::chrono::milliseconds write_stall_;
  std::chrono::milliseconds bookmark_interval_;  // Constant once started.

  std::mutex mutex_;                            // Guards everything below.
  grpc::CallbackServerContext* const context_;  // Valid until kDone.
  State state_ = State::kIdle;
  std::optional<grpc::Status> end_;    // Finish with it when idle.
  std::unique_ptr<LogCursor> cursor_;  // None until opened.
  std::optional<v1::Job> snapshot_;    // Not sent yet.
  v1::WatchJobResponse out_;           // Belongs to gRPC while kWriting.
  std::chrono::steady_clock::time_point last_write_;
  std::shared_ptr<WatchReactor> self_;  // Until kDone.
};

}  // namespace contact
