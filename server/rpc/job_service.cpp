#include "rpc/job_service.h"

#include <grpcpp/impl/codegen/proto_utils.h>

#include <utility>

#include "base/spelling.h"
#include "jobs/job/errors.h"
#include "rpc/stream/watch_source.h"

namespace contact {
namespace {

v1::Principal ToMessage(const Principal& principal) {
  v1::Principal message;
  message.set_name(principal.name);
  message.set_tenant(principal.tenant);
  for (const Role role : principal.roles) message.add_roles(NameOf(role));
  message.set_how(principal.how);
  return message;
}

}  // namespace

using grpc::ServerUnaryReactor;
using grpc::ServerWriteReactor;

ServerUnaryReactor* JobService::CreateJob(Context* context, const grpc::ByteBuffer* request,
                                          grpc::ByteBuffer* response) {
  const Call call{"/contact.v1.JobService/CreateJob", "", CallKind::kCreateJob};
  return calls_.Unary<v1::Job>(context, call, response, [&](const auto& caller, auto answer) {
    v1::CreateJobRequest parsed;
    std::shared_ptr<const void> place;
    if (const auto error = requests_.Parse(*request, &parsed, &place)) return answer(*error);
    const auto done = [answer, place](Result<v1::Job> job) { answer(std::move(job)); };
    jobs_.creator().Create(caller, std::move(parsed), done, Abandonment(*context));
  });
}

ServerUnaryReactor* JobService::GetJob(Context* context, const v1::GetJobRequest* request,
                                       v1::Job* response) {
  const Call call{"/contact.v1.JobService/GetJob", request->name()};
  return calls_.Unary<v1::Job>(context, call, response, [&](const auto& caller, auto answer) {
    jobs_.reader().Get(caller, request->name(), answer);
  });
}

ServerUnaryReactor* JobService::ListJobs(Context* context, const v1::ListJobsRequest* request,
                                         v1::ListJobsResponse* response) {
  const Call call{"/contact.v1.JobService/ListJobs"};
  return calls_.Unary<v1::ListJobsResponse>(
      context, call, response,
      [&](const auto& caller, auto answer) { jobs_.reader().List(caller, *request, answer); });
}

ServerUnaryReactor* JobService::CancelJob(Context* context, const v1::CancelJobRequest* request,
                                          v1::Job* response) {
  const Call call{"/contact.v1.JobService/CancelJob", request->name()};
  return calls_.Unary<v1::Job>(context, call, response, [&](const auto& caller, auto answer) {
    jobs_.Cancel(caller, *request, answer);
  });
}

ServerUnaryReactor* JobService::DeleteJob(Context* context, const v1::DeleteJobRequest* request,
                                          google::protobuf::Empty* response) {
  const Call call{"/contact.v1.JobService/DeleteJob", request->name()};
  return calls_.Unary<bool>(context, call, response, [&](const auto& caller, auto answer) {
    jobs_.Delete(caller, *request, answer);
  });
}

ServerUnaryReactor* JobService::GetSeries(Context* context, const v1::GetSeriesRequest* request,
                                          v1::Series* response) {
  const Call call{"/contact.v1.JobService/GetSeries", request->name()};
  return calls_.Unary<v1::Series>(context, call, response, [&](const auto& caller, auto answer) {
    jobs_.recordings().GetSeries(caller, *request, answer, Abandonment(*context));
  });
}

ServerUnaryReactor* JobService::GetServerInfo(Context* context,
                                              const v1::GetServerInfoRequest* /*request*/,
                                              v1::ServerInfo* response) {
  const Call call{"/contact.v1.JobService/GetServerInfo"};
  return calls_.Unary<v1::ServerInfo>(
      context, call, response, [&](const auto& caller, auto answer) {
        jobs_.InfoFor(caller, [this, caller, answer](Result<v1::ServerInfo> info) {
          if (!info.ok()) return answer(info.error());
          info.value().MergeFrom(identity_);
          *info.value().mutable_principal() = ToMessage(caller);
          answer(std::move(info));
        });
      });
}

ServerWriteReactor<grpc::ByteBuffer>* JobService::WatchJob(Context* context,
                                                           const grpc::ByteBuffer* request) {
  v1::WatchJobRequest parsed;
  grpc::ByteBuffer bytes = *request;
  const bool readable =
      grpc::SerializationTraits<v1::WatchJobRequest>::Deserialize(&bytes, &parsed).ok();
  const auto open = [&](const auto& caller, auto wake, auto opened) {
    if (!readable) {
      return opened(MakeError(Reason::kFieldInvalid, "the request is no WatchJobRequest"));
    }
    const auto watched = [opened, &loop = calls_.loop()](Result<WatchedJob> job) {
      if (!job.ok()) return opened(job.error());
      opened(MakeWatchSource(std::move(job.value()), loop.clock(), *loop.metrics()));
    };
    jobs_.watches().WatchJob(caller, parsed, wake, watched);
  };
  const Call call{"/contact.v1.JobService/WatchJob", parsed.name(), CallKind::kStream};
  return calls_.Stream<grpc::ByteBuffer>(context, call, "job=" + Shortened(parsed.name()), open);
}

ServerWriteReactor<v1::WatchJobsResponse>* JobService::WatchJobs(
    Context* context, const v1::WatchJobsRequest* request) {
  const Call call{"/contact.v1.JobService/WatchJobs", "", CallKind::kStream};
  return calls_.Stream<v1::WatchJobsResponse>(
      context, call, "job=*", [&](const auto& caller, auto wake, auto opened) {
        opened(jobs_.watches().WatchJobs(caller, *request, wake));
      });
}

ServerWriteReactor<v1::ReadArtifactResponse>* JobService::ReadArtifact(
    Context* context, const v1::ReadArtifactRequest* request) {
  const Call call{"/contact.v1.JobService/ReadArtifact", request->name(), CallKind::kStream};
  return calls_.Stream<v1::ReadArtifactResponse>(context, call, "job=" + Shortened(request->name()),
                                                 [&](const auto& caller, auto wake, auto opened) {
                                                   jobs_.recordings().ReadArtifact(caller, *request,
                                                                                   wake, opened);
                                                 });
}

}  // namespace contact
