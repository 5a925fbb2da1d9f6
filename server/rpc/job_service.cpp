#include "rpc/job_service.h"

#include <utility>

#include "rpc/call/status.h"
#include "rpc/stream/artifact_reactor.h"
#include "rpc/stream/refused_stream.h"
#include "rpc/stream/watch_jobs_reactor.h"
#include "rpc/stream/watch_reactor.h"

namespace contact {
namespace {

void Put(bool /*done*/, google::protobuf::Empty* /*response*/) {}

template <class T>
void Put(T value, T* response) {
  *response = std::move(value);
}

}  // namespace

JobService::JobService(JobManager& jobs, std::shared_ptr<WatchLoop> watches, CallGuard& guard,
                       v1::ServerInfo identity, std::chrono::milliseconds write_stall)
    : jobs_(jobs),
      watches_(std::move(watches)),
      guard_(guard),
      identity_(std::move(identity)),
      write_stall_(write_stall) {}

// Finishes a unary call with the result that `run` makes, at once or later.
template <class T, class Response, class Run>
grpc::ServerUnaryReactor* JobService::Serve(grpc::CallbackServerContext* context,
                                            Response* response, Run run) {
  auto* reactor = context->DefaultReactor();
  const auto answer = [reactor, response](Result<T> result) {
    if (!result.ok()) return reactor->Finish(ToGrpc(result.error()));
    Put(std::move(result.value()), response);
    reactor->Finish(grpc::Status::OK);
  };
  if (const auto refusal = guard_.Check(*context)) {
    answer(*refusal);
  } else {
    run(answer);
  }
  return reactor;
}

grpc::ServerUnaryReactor* JobService::CreateJob(grpc::CallbackServerContext* context,
                                                const v1::CreateJobRequest* request,
                                                v1::Job* response) {
  return Serve<v1::Job>(context, response, [&](auto answer) {
    if (const auto refusal = guard_.CheckCreate(*context)) return answer(*refusal);
    // gRPC made it for this call alone, and a large scenario need not be in memory twice.
    auto& mine = const_cast<v1::CreateJobRequest&>(*request);
    jobs_.Create(std::move(mine), answer, Abandonment(*context));
  });
}

grpc::ServerUnaryReactor* JobService::GetJob(grpc::CallbackServerContext* context,
                                             const v1::GetJobRequest* request, v1::Job* response) {
  return Serve<v1::Job>(context, response,
                        [&](auto answer) { jobs_.Get(request->name(), answer); });
}

grpc::ServerUnaryReactor* JobService::ListJobs(grpc::CallbackServerContext* context,
                                               const v1::ListJobsRequest* request,
                                               v1::ListJobsResponse* response) {
  return Serve<v1::ListJobsResponse>(context, response,
                                     [&](auto answer) { jobs_.List(*request, answer); });
}

grpc::ServerUnaryReactor* JobService::CancelJob(grpc::CallbackServerContext* context,
                                                const v1::CancelJobRequest* request,
                                                v1::Job* response) {
  return Serve<v1::Job>(context, response, [&](auto answer) { jobs_.Cancel(*request, answer); });
}

grpc::ServerUnaryReactor* JobService::DeleteJob(grpc::CallbackServerContext* context,
                                                const v1::DeleteJobRequest* request,
                                                google::protobuf::Empty* response) {
  return Serve<bool>(context, response, [&](auto answer) { jobs_.Delete(*request, answer); });
}

grpc::ServerWriteReactor<grpc::ByteBuffer>* JobService::WatchJob(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  if (const auto refusal = guard_.CheckStream(*context)) {
    return new RefusedStream<grpc::ByteBuffer>(*refusal);
  }
  return WatchReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerWriteReactor<v1::WatchJobsResponse>* JobService::WatchJobs(
    grpc::CallbackServerContext* context, const v1::WatchJobsRequest* request) {
  if (const auto refusal = guard_.CheckStream(*context)) {
    return new RefusedStream<v1::WatchJobsResponse>(*refusal);
  }
  return WatchJobsReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerWriteReactor<v1::ReadArtifactResponse>* JobService::ReadArtifact(
    grpc::CallbackServerContext* context, const v1::ReadArtifactRequest* request) {
  if (const auto refusal = guard_.CheckStream(*context)) {
    return new RefusedStream<v1::ReadArtifactResponse>(*refusal);
  }
  return ArtifactReactor::Start(jobs_, watches_, context, *request, write_stall_);
}

grpc::ServerUnaryReactor* JobService::GetSeries(grpc::CallbackServerContext* context,
                                                const v1::GetSeriesRequest* request,
                                                v1::Series* response) {
  return Serve<v1::Series>(context, response, [&](auto answer) {
    jobs_.Series(*request, answer, Abandonment(*context));
  });
}

grpc::ServerUnaryReactor* JobService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const v1::GetServerInfoRequest* /*request*/,
                                                    v1::ServerInfo* response) {
  return Serve<v1::ServerInfo>(context, response, [&](auto answer) {
    v1::ServerInfo info = jobs_.Info();
    info.MergeFrom(identity_);
    answer(std::move(info));
  });
}

}  // namespace contact
