#pragma once

#include <grpcpp/grpcpp.h>

#include <utility>

#include "contact/v1/job_service.grpc.pb.h"
#include "jobs/job_manager.h"
#include "rpc/call/request_budget.h"
#include "rpc/call_starter.h"

namespace contact {

/// The calls of the contract's JobService. Each is handed to the part of the JobManager that
/// answers it. Handlers never wait, because gRPC runs all of them on a few threads.
///
/// Streams send serialised bytes: WatchJob, so that an event is serialised once for all watchers,
/// the others, so that readers who stall keep nothing else. CreateJob takes bytes, so that what a
/// request would take is known before it is parsed.
class JobService final : public v1::JobService::WithRawCallbackMethod_CreateJob<
                             v1::JobService::WithRawCallbackMethod_WatchJob<
                                 v1::JobService::WithRawCallbackMethod_WatchJobs<
                                     v1::JobService::WithRawCallbackMethod_ReadArtifact<
                                         v1::JobService::CallbackService>>>> {
 public:
  /// `identity` is the answer of GetServerInfo without the numbers that the manager knows. The
  /// manager and `calls` outlive the service.
  JobService(JobManager& jobs, CallStarter& calls, v1::ServerInfo identity)
      : jobs_(jobs), calls_(calls), identity_(std::move(identity)) {}

 private:
  using Context = grpc::CallbackServerContext;
  using Unary = grpc::ServerUnaryReactor;
  using Bytes = grpc::ByteBuffer;
  using Stream = grpc::ServerWriteReactor<Bytes>;

  /// Answered by JobCreator once the job is on disk. Limited for each peer, see CallKind.
  Unary* CreateJob(Context* context, const Bytes* request, Bytes* response) override;
  /// Answered by JobReader, with ledger and artifacts.
  Unary* GetJob(Context* context, const v1::GetJobRequest* request, v1::Job* response) override;
  /// Answered by JobReader, with a page of headers.
  Unary* ListJobs(Context* context, const v1::ListJobsRequest* request,
                  v1::ListJobsResponse* response) override;
  /// Answered by the manager once it is stored that the job is to stop.
  Unary* CancelJob(Context* context, const v1::CancelJobRequest* request,
                   v1::Job* response) override;
  /// Answered by the manager once the change is stored.
  Unary* UpdateJob(Context* context, const v1::UpdateJobRequest* request,
                   v1::Job* response) override;
  /// Answered by the manager once the job is gone from the disk.
  Unary* DeleteJob(Context* context, const v1::DeleteJobRequest* request,
                   google::protobuf::Empty* response) override;
  /// Answered by Recordings, on the thread that checks scenarios.
  Unary* GetSeries(Context* context, const v1::GetSeriesRequest* request,
                   v1::Series* response) override;
  /// Answered by the manager, with `identity`.
  Unary* GetServerInfo(Context* context, const v1::GetServerInfoRequest* request,
                       v1::ServerInfo* response) override;
  /// Opened by Watches; a WatchSource makes the messages.
  Stream* WatchJob(Context* context, const Bytes* request) override;
  /// Opened by Watches; a JobsCursor makes the messages.
  Stream* WatchJobs(Context* context, const Bytes* request) override;
  /// Opened by Recordings; an ArtifactReader makes the messages.
  Stream* ReadArtifact(Context* context, const Bytes* request) override;

  /// Starts a stream whose request is a `Request`; FIELD_INVALID if the bytes are none.
  /// `open(caller, request, wake, opened)`: see CallStarter::Stream.
  template <class Request, class Open>
  Stream* Start(Context* context, const char* method, const Bytes& request, Open open);

  JobManager& jobs_;
  CallStarter& calls_;
  /// Memory of CreateJob requests that are not answered yet.
  RequestBudget requests_{256 << 20};
  /// The part of GetServerInfo that never changes.
  const v1::ServerInfo identity_;
};

}  // namespace contact
