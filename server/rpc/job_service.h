#pragma once

#include <grpcpp/grpcpp.h>

#include <utility>

#include "contact/v1/job_service.grpc.pb.h"
#include "jobs/job_manager.h"
#include "rpc/call_starter.h"

namespace contact {

/// The calls of the contract's JobService, each handed to the JobManager. Handlers never wait,
/// because gRPC runs all of them on a few threads.
///
/// WatchJob sends serialised bytes, so that an event is serialised once for all watchers.
class JobService final
    : public v1::JobService::WithRawCallbackMethod_WatchJob<v1::JobService::CallbackService> {
 public:
  /// `identity` is the answer of GetServerInfo without the numbers that the manager knows. The
  /// manager and `calls` outlive the service.
  JobService(JobManager& jobs, CallStarter& calls, v1::ServerInfo identity)
      : jobs_(jobs), calls_(calls), identity_(std::move(identity)) {}

 private:
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
  CallStarter& calls_;
  const v1::ServerInfo identity_;
};

}  // namespace contact
