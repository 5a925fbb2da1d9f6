#include "rpc/job_service.h"

#include <grpcpp/impl/codegen/proto_utils.h>

#include <utility>

#include "base/spelling.h"
#include "jobs/job/errors.h"
#include "rpc/stream/watch_source.h"

namespace contact {

using grpc::ServerUnaryReactor;
using grpc::ServerWriteReactor;

ServerUnaryReactor* JobService::CreateJob(Context* context, const grpc::ByteBuffer* request,
                                          grpc::ByteBuffer* response) {
  const auto run = [&](auto answer) {
    v1::CreateJobRequest parsed;
    std::shared_ptr<const void> place;
    if (const auto error = requests_.Parse(*request, &parsed, &place)) return answer(*error);
    const auto done = [answer, place](Result<v1::Job> job) { answer(std::move(job)); };
    jobs_.creator().Create(std::move(parsed), done, Abandonment(*context));
  };
  return calls_.Unary<v1::Job>(context, response, run, CallKind::kCreateJob);
}

ServerUnaryReactor* JobService::GetJob(Context* context, const v1::GetJobRequest* request,
                                       v1::Job* response) {
  return calls_.Unary<v1::Job>(context, response,
                               [&](auto answer) { jobs_.reader().Get(request->name(), answer); });
}

ServerUnaryReactor* JobService::ListJobs(Context* context, const v1::ListJobsRequest* request,
                                         v1::ListJobsResponse* response) {
  return calls_.Unary<v1::ListJobsResponse>(
      context, response, [&](auto answer) { jobs_.reader().List(*request, answer); });
}

ServerUnaryReactor* JobService::CancelJob(Context* context, const v1::CancelJobRequest* request,
                                          v1::Job* response) {
  return calls_.Unary<v1::Job>(context, response,
                               [&](auto answer) { jobs_.Cancel(*request, answer); });
}

ServerUnaryReactor* JobService::DeleteJob(Context* context, const v1::DeleteJobRequest* request,
                                          google::protobuf::Empty* response) {
  return calls_.Unary<bool>(context, response,
                            [&](auto answer) { jobs_.Delete(*request, answer); });
}

ServerUnaryReactor* JobService::GetSeries(Context* context, const v1::GetSeriesRequest* request,
                                          v1::Series* response) {
  return calls_.Unary<v1::Series>(context, response, [&](auto answer) {
    jobs_.recordings().GetSeries(*request, answer, Abandonment(*context));
  });
}

ServerUnaryReactor* JobService::GetServerInfo(Context* context,
                                              const v1::GetServerInfoRequest* /*request*/,
                                              v1::ServerInfo* response) {
  return calls_.Unary<v1::ServerInfo>(context, response, [&](auto answer) {
    v1::ServerInfo info = jobs_.Info();
    info.MergeFrom(identity_);
    answer(std::move(info));
  });
}

ServerWriteReactor<grpc::ByteBuffer>* JobService::WatchJob(Context* context,
                                                           const grpc::ByteBuffer* request) {
  v1::WatchJobRequest parsed;
  grpc::ByteBuffer bytes = *request;
  const bool readable =
      grpc::SerializationTraits<v1::WatchJobRequest>::Deserialize(&bytes, &parsed).ok();
  const auto open = [&](auto wake, auto opened) {
    if (!readable) {
      return opened(MakeError(Reason::kFieldInvalid, "the request is no WatchJobRequest"));
    }
    const auto watched = [opened, &loop = calls_.loop()](Result<WatchedJob> job) {
      if (!job.ok()) return opened(job.error());
      opened(MakeWatchSource(std::move(job.value()), loop.clock(), *loop.metrics()));
    };
    jobs_.watches().WatchJob(parsed, wake, watched);
  };
  return calls_.Stream<grpc::ByteBuffer>(context, "job=" + Shortened(parsed.name()), open);
}

ServerWriteReactor<v1::WatchJobsResponse>* JobService::WatchJobs(
    Context* context, const v1::WatchJobsRequest* request) {
  return calls_.Stream<v1::WatchJobsResponse>(context, "job=*", [&](auto wake, auto opened) {
    opened(jobs_.watches().WatchJobs(*request, wake));
  });
}

ServerWriteReactor<v1::ReadArtifactResponse>* JobService::ReadArtifact(
    Context* context, const v1::ReadArtifactRequest* request) {
  return calls_.Stream<v1::ReadArtifactResponse>(
      context, "job=" + Shortened(request->name()),
      [&](auto wake, auto opened) { jobs_.recordings().ReadArtifact(*request, wake, opened); });
}

}  // namespace contact
