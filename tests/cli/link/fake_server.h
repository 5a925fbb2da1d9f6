#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "cli/link/loopback_server.h"
#include "contact/v1/job_service.grpc.pb.h"

namespace contact::cli {

/// A JobService on a loopback port whose answers a test decides.
class FakeServer : public v1::JobService::Service {
 public:
  using Writer = grpc::ServerWriter<v1::WatchJobResponse>;
  using WatchHandler = std::function<grpc::Status(const v1::WatchJobRequest&, Writer&)>;
  using JobsWriter = grpc::ServerWriter<v1::WatchJobsResponse>;
  using WatchJobsHandler = std::function<grpc::Status(const v1::WatchJobsRequest&, JobsWriter&)>;
  using CreateHandler = std::function<grpc::Status(const v1::CreateJobRequest&, v1::Job*)>;

  const std::string& address() const { return server_.address(); }

  /// Handlers run one at a time.
  void OnWatch(WatchHandler handler) {
    const std::scoped_lock lock(mutex_);
    on_watch_ = std::move(handler);
  }
  void OnWatchJobs(WatchJobsHandler handler) {
    const std::scoped_lock lock(mutex_);
    on_watch_jobs_ = std::move(handler);
  }
  void OnCreate(CreateHandler handler) {
    const std::scoped_lock lock(mutex_);
    on_create_ = std::move(handler);
  }

  /// After it, what handlers wrote can be read.
  void Settle() { const std::scoped_lock lock(mutex_); }

 private:
  grpc::Status WatchJob(grpc::ServerContext*, const v1::WatchJobRequest* request,
                        Writer* writer) override {
    const std::scoped_lock lock(mutex_);
    return on_watch_(*request, *writer);
  }
  grpc::Status WatchJobs(grpc::ServerContext*, const v1::WatchJobsRequest* request,
                         JobsWriter* writer) override {
    const std::scoped_lock lock(mutex_);
    return on_watch_jobs_(*request, *writer);
  }
  grpc::Status CreateJob(grpc::ServerContext*, const v1::CreateJobRequest* request,
                         v1::Job* job) override {
    const std::scoped_lock lock(mutex_);
    return on_create_(*request, job);
  }

  std::mutex mutex_;
  WatchHandler on_watch_;
  WatchJobsHandler on_watch_jobs_;
  CreateHandler on_create_;
  LoopbackServer server_{this};
};

}  // namespace contact::cli
