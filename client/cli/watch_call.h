#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>

#include "contact/v1/job_service.grpc.pb.h"

namespace contact::cli {

/// One WatchJob stream, read with a limit on how long a read waits. Not thread-safe.
class WatchCall {
 public:
  enum class Next {
    kMessage,  ///< `message` holds one.
    kNothing,  ///< None came in time.
    kEnd,      ///< The stream ended; see status().
  };

  WatchCall(v1::JobService::StubInterface& stub, const v1::WatchJobRequest& request);
  ~WatchCall();  ///< Cancels the stream if it has not ended.

  Next Read(std::chrono::milliseconds limit, v1::WatchJobResponse* message);
  const grpc::Status& status() const { return status_; }

 private:
  enum class Pending { kStart, kRead, kFinish, kNone };

  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReaderInterface<v1::WatchJobResponse>> stream_;
  Pending pending_ = Pending::kStart;
  v1::WatchJobResponse response_;
  grpc::Status status_;
};

}  // namespace contact::cli
