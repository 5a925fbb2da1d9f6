#include "rpc/job_service.h"

#include <grpcpp/impl/codegen/proto_utils.h>

#include <memory>
#include <string>
#include <utility>

#include "jobs/job/errors.h"
#include "rpc/stream/job_sources.h"
#include "rpc/stream/watch_source.h"

namespace contact {
namespace {

Error NoRequest() { return MakeError(Reason::kFieldInvalid, "the request is no WatchJobRequest"); }

}  // namespace

grpc::ServerUnaryReactor* JobService::CreateJob(grpc::CallbackServerContext* context,
                                                const v1::CreateJobRequest* request,
                                                v1::Job* response) {
  const auto run = [&](auto answer) {
    // gRPC made the request for this call alone, and a large scenario need not be in memory twice.
    auto& mine = const_cast<v1::CreateJobRequest&>(*request);
    jobs_.Create(std::move(mine), answer, Abandonment(*context));
  };
  return calls_.Unary<v1::Job>(context, response, run, CallKind::kCreateJob);
}

grpc::ServerUnaryReactor* JobService::GetJob(grpc::CallbackServerContext* context,
                                             const v1::GetJobRequest* request, v1::Job* response) {
  return calls_.Unary<v1::Job>(context, response,
                               [&](auto answer) { jobs_.Get(request->name(), answer); });
}

grpc::ServerUnaryReactor* JobService::ListJobs(grpc::CallbackServerContext* context,
                                               const v1::ListJobsRequest* request,
                                               v1::ListJobsResponse* response) {
  return calls_.Unary<v1::ListJobsResponse>(context, response,
                                            [&](auto answer) { jobs_.List(*request, answer); });
}

grpc::ServerUnaryReactor* JobService::CancelJob(grpc::CallbackServerContext* context,
                                                const v1::CancelJobRequest* request,
                                                v1::Job* response) {
  return calls_.Unary<v1::Job>(context, response,
                               [&](auto answer) { jobs_.Cancel(*request, answer); });
}

grpc::ServerUnaryReactor* JobService::DeleteJob(grpc::CallbackServerContext* context,
                                                const v1::DeleteJobRequest* request,
                                                google::protobuf::Empty* response) {
  return calls_.Unary<bool>(context, response,
                            [&](auto answer) { jobs_.Delete(*request, answer); });
}

grpc::ServerWriteReactor<grpc::ByteBuffer>* JobService::WatchJob(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  v1::WatchJobRequest parsed;
  grpc::ByteBuffer bytes = *request;
  const bool readable =
      grpc::SerializationTraits<v1::WatchJobRequest>::Deserialize(&bytes, &parsed).ok();
  const auto open = [&](auto wake, auto opened) {
    if (!readable) return opened(NoRequest());
    const StreamLoop& loop = calls_.loop();
    jobs_.Watch(
        parsed, wake, [opened, &loop, name = parsed.name()](Result<JobManager::Watched> watched) {
          if (!watched.ok()) return opened(watched.error());
          opened(MakeWatchSource(std::move(watched.value()), name, loop.clock(), *loop.metrics()));
        });
  };
  return calls_.Stream<grpc::ByteBuffer>(context, "job=" + parsed.name(), open);
}

grpc::ServerWriteReactor<v1::WatchJobsResponse>* JobService::WatchJobs(
    grpc::CallbackServerContext* context, const v1::WatchJobsRequest* request) {
  return calls_.Stream<v1::WatchJobsResponse>(context, "job=*", [&](auto wake, auto opened) {
    auto watched = jobs_.Watch(*request, wake);
    if (!watched.ok()) return opened(watched.error());
    opened(MakeJobsSource(std::move(watched.value()), calls_.loop().clock()));
  });
}

grpc::ServerWriteReactor<v1::ReadArtifactResponse>* JobService::ReadArtifact(
    grpc::CallbackServerContext* context, const v1::ReadArtifactRequest* request) {
  const auto open = [&](auto wake, auto opened) {
    jobs_.ReadArtifact(*request, wake, [opened](Result<std::unique_ptr<ArtifactReader>> reader) {
      if (!reader.ok()) return opened(reader.error());
      opened(MakeArtifactSource(std::move(reader.value())));
    });
  };
  return calls_.Stream<v1::ReadArtifactResponse>(context, "job=" + request->name(), open);
}

grpc::ServerUnaryReactor* JobService::GetSeries(grpc::CallbackServerContext* context,
                                                const v1::GetSeriesRequest* request,
                                                v1::Series* response) {
  return calls_.Unary<v1::Series>(context, response, [&](auto answer) {
    jobs_.Series(*request, answer, Abandonment(*context));
  });
}

grpc::ServerUnaryReactor* JobService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const v1::GetServerInfoRequest* /*request*/,
                                                    v1::ServerInfo* response) {
  return calls_.Unary<v1::ServerInfo>(context, response, [&](auto answer) {
    v1::ServerInfo info = jobs_.Info();
    info.MergeFrom(identity_);
    answer(std::move(info));
  });
}

}  // namespace contact
