#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>

#include "contact/v1/job_service.grpc.pb.h"
#include "jobs/job_manager.h"
#include "rpc/call/call_guard.h"
#include "rpc/stream/watch_loop.h"

namespace contact {

/// The calls of the contract, each handed to the JobManager. No handler waits for anything: gRPC
/// runs all of them on a few threads.
///
/// WatchJob works on bytes, so that an event is serialised once for all who watch.
class JobService final
    : public v1::JobService::WithRawCallbackMethod_WatchJob<v1::JobService::CallbackService> {
 public:
  /// `identity` is what GetServerInfo answers, but for the numbers that the manager knows.
  JobService(JobManager& jobs, std::shared_ptr<WatchLoop> watches, CallGuard& guard,
             v1::ServerInfo identity, std::chrono::milliseconds write_stall);

 private:
  template <class T, class Response, class Run>
  grpc::ServerUnaryReactor* Serve(grpc::CallbackServerContext* context, Response* response,
                                  Run run);

  grpc::ServerUnaryReactor* CreateJob(grpc::CallbackServerContext* context,
                                      const v1::CreateJobRequest* request,
                                      v1::Job* response) override;
  grpc::ServerUnaryReactor* GetJob(grpc::CallbackServerContext* context,
                                   const v1::GetJobRequest* request, v1::Job* response) override;
  grpc::ServerUnaryReactor* ListJobs(grpc::CallbackServerContext* context,
                                     const v1::ListJobsRequest* request,
                                     v1::ListJobsResponse* response) override;
  grpc::ServerUnaryReactor* CancelJob(grpc::CallbackServerContext* context,
                                      const v1::CancelJobRequest* request,
                                      v1::Job* response) override;
  grpc::ServerUnaryReactor* DeleteJob(grpc::CallbackServerContext* context,
                                      const v1::DeleteJobRequest* request,
                                      google::protobuf::Empty* response) override;
  grpc::ServerWriteReactor<grpc::ByteBuffer>* WatchJob(grpc::CallbackServerContext* context,
                                                       const grpc::ByteBuffer* request) override;
  grpc::ServerWriteReactor<v1::WatchJobsResponse>* WatchJobs(
      grpc::CallbackServerContext* context, const v1::WatchJobsRequest* request) override;
  grpc::ServerWriteReactor<v1::ReadArtifactResponse>* ReadArtifact(
      grpc::CallbackServerContext* context, const v1::ReadArtifactRequest* request) override;
  grpc::ServerUnaryReactor* GetSeries(grpc::CallbackServerContext* context,
                                      const v1::GetSeriesRequest* request,
                                      v1::Series* response) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::ServerInfo* response) override;

  JobManager& jobs_;
  const std::shared_ptr<WatchLoop> watches_;
  CallGuard& guard_;
  const v1::ServerInfo identity_;
  const std::chrono::milliseconds write_stall_;
};

}  // namespace contact
