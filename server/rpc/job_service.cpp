#include "rpc/job_service.h"

#include <grpcpp/impl/codegen/proto_utils.h>

#include <string>
#include <utility>

#include "base/spelling.h"
#include "jobs/job/errors.h"
#include "rpc/stream/serialized_source.h"
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

ServerUnaryReactor* JobService::CreateJob(Context* context, const Bytes* request, Bytes* response) {
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

ServerUnaryReactor* JobService::UpdateJob(Context* context, const v1::UpdateJobRequest* request,
                                          v1::Job* response) {
  const Call call{"/contact.v1.JobService/UpdateJob", request->job().name()};
  return calls_.Unary<v1::Job>(context, call, response, [&](const auto& caller, auto answer) {
    jobs_.Update(caller, *request, answer);
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

template <class Request, class Open>
JobService::Stream* JobService::Start(Context* context, const char* method, const Bytes& request,
                                      Open open) {
  Request parsed;
  Bytes bytes = request;
  const bool readable = grpc::SerializationTraits<Request>::Deserialize(&bytes, &parsed).ok();
  std::string name;  // WatchJobs has none.
  if constexpr (requires { parsed.name(); }) name = parsed.name();
  const Call call{method, name, CallKind::kStream};
  const std::string label = "job=" + (name.empty() ? "*" : Shortened(name));
  return calls_.Stream<Bytes>(
      context, call, label, [&](const auto& caller, auto wake, auto opened) {
        if (readable) return open(caller, parsed, wake, opened);
        const std::string type = Request::descriptor()->name();
        opened(MakeError(Reason::kFieldInvalid, "the request is no " + type));
      });
}

JobService::Stream* JobService::WatchJob(Context* context, const Bytes* request) {
  return Start<v1::WatchJobRequest>(
      context, "/contact.v1.JobService/WatchJob", *request,
      [&](const auto& caller, const auto& parsed, auto wake, auto opened) {
        const auto watched = [opened, &loop = calls_.loop()](Result<WatchedJob> job) {
          if (!job.ok()) return opened(job.error());
          opened(MakeWatchSource(std::move(job.value()), loop.clock(), *loop.metrics()));
        };
        jobs_.watches().WatchJob(caller, parsed, wake, watched);
      });
}

JobService::Stream* JobService::WatchJobs(Context* context, const Bytes* request) {
  return Start<v1::WatchJobsRequest>(
      context, "/contact.v1.JobService/WatchJobs", *request,
      [&](const auto& caller, const auto& parsed, auto wake, auto opened) {
        SerializedSource<v1::WatchJobsResponse>::Opens(opened)(
            jobs_.watches().WatchJobs(caller, parsed, wake));
      });
}

JobService::Stream* JobService::ReadArtifact(Context* context, const Bytes* request) {
  return Start<v1::ReadArtifactRequest>(
      context, "/contact.v1.JobService/ReadArtifact", *request,
      [&](const auto& caller, const auto& parsed, auto wake, auto opened) {
        jobs_.recordings().ReadArtifact(caller, parsed, wake,
                                        SerializedSource<v1::ReadArtifactResponse>::Opens(opened));
      });
}

}  // namespace contact
