#include "rpc/job_service.h"

#include <utility>

#include "rpc/artifact_reactor.h"
#include "rpc/status.h"
#include "rpc/watch_jobs_reactor.h"
#include "rpc/watch_reactor.h"

namespace contact {
namespace {

// Finishes a unary call with what the manager answers.
template <class T>
auto Answer(grpc::ServerUnaryReactor* reactor, T* response) {
  return [reactor, response](Result<T> result) {
    if (!result.ok()) return reactor->Finish(ToGrpc(result.error()));
    *response = std::move(result.value());
    reactor->Finish(grpc::Status::OK);
  };
}

}  // namespace

JobService::JobService(JobManager& jobs, std::shared_ptr<WatchLoop> watches,
                       v1::ServerInfo identity, std::chrono::milliseconds write_stall)
    : jobs_(jobs),
      watches_(std::move(watches)),
      identity_(std::move(identity)),
      write_stall_(write_stall) {}

grpc::ServerUnaryReactor* JobService::CreateJob(grpc::CallbackServerContext* context,
                                                const v1::CreateJobRequest* request,
                                                v1::Job* response) {
  auto* reactor = context->DefaultReactor();
  jobs_.Create(*request, Answer(reactor, response));
  return reactor;
}

grpc::ServerUnaryReactor* JobService::GetJob(grpc::CallbackServerContext* context,
                                             const v1::GetJobRequest* request, v1::Job* response) {
  auto* reactor = context->DefaultReactor();
  jobs_.Get(request->name(), Answer(reactor, response));
  return reactor;
}

grpc::ServerUnaryReactor* JobService::ListJobs(grpc::CallbackServerContext* context,
                                               const v1::ListJobsRequest* request,
                                               v1::ListJobsResponse* response) {
  auto* reactor = context->DefaultReactor();
  jobs_.List(*request, Answer(reactor, response));
  return reactor;
}

grpc::ServerUnaryReactor* JobService::CancelJob(grpc::CallbackServerContext* context,
                                                const v1::CancelJobRequest* request,
                                                v1::Job* response) {
  auto* reactor = context->DefaultReactor();
  jobs_.Cancel(request->name(), Answer(reactor, response));
  return reactor;
}

grpc::ServerUnaryReactor* JobService::DeleteJob(grpc::CallbackServerContext* context,
                                                const v1::DeleteJobRequest* request,
                                                google::protobuf::Empty* /*response*/) {
  auto* reactor = context->DefaultReactor();
  jobs_.Delete(request->name(), [reactor](const Result<bool>& result) {
    reactor->Finish(result.ok() ? grpc::Status::OK : ToGrpc(result.error()));
  });
  return reactor;
}

grpc::ServerWriteReactor<grpc::ByteBuffer>* JobService::WatchJob(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  return WatchReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerWriteReactor<v1::WatchJobsResponse>* JobService::WatchJobs(
    grpc::CallbackServerContext* context, const v1::WatchJobsRequest* request) {
  return WatchJobsReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerWriteReactor<v1::ReadArtifactResponse>* JobService::ReadArtifact(
    grpc::CallbackServerContext* context, const v1::ReadArtifactRequest* request) {
  return ArtifactReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerUnaryReactor* JobService::GetSeries(grpc::CallbackServerContext* context,
                                                const v1::GetSeriesRequest* request,
                                                v1::Series* response) {
  auto* reactor = context->DefaultReactor();
  jobs_.Series(*request, Answer(reactor, response));
  return reactor;
}

grpc::ServerUnaryReactor* JobService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const v1::GetServerInfoRequest* /*request*/,
                                                    v1::ServerInfo* response) {
  auto* reactor = context->DefaultReactor();
  *response = jobs_.Info();
  response->MergeFrom(identity_);
  reactor->Finish(grpc::Status::OK);
  return reactor;
}

}  // namespace contact
