#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "storage/postgres/connection.h"

namespace contact {

/// What is left of a front without a service: gRPC before, libpq behind. Each CreateJob stores a
/// job with the statement that a front sends, and nothing is checked. What waits is one
/// transaction.
class BareFront final : public v1::JobService::CallbackService {
 public:
  using Insert = std::function<postgres::Statement()>;

  /// `insert` makes the statement of a new job, on any thread. Begins to serve.
  BareFront(std::unique_ptr<postgres::Connection> connection, Insert insert);
  ~BareFront() override;

  int port() const { return port_; }

 private:
  struct Call {
    postgres::Statement statement;
    grpc::ServerUnaryReactor* reactor;
  };

  grpc::ServerUnaryReactor* CreateJob(grpc::CallbackServerContext* context,
                                      const v1::CreateJobRequest* request, v1::Job* job) override;
  /// What the thread does.
  void Loop(const std::stop_token& stop);

  const std::unique_ptr<postgres::Connection> connection_;
  const Insert insert_;
  Mutex mutex_;
  // Signals a call.
  std::condition_variable_any called_;
  std::vector<Call> calls_ ABSL_GUARDED_BY(mutex_);
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
  std::jthread thread_;
};

}  // namespace contact
