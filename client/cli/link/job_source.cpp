#include "cli/link/job_source.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <filesystem>

#include "cli/base/text_file.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/link/job_names.h"

namespace contact::cli {
namespace {

v1::Job ReadJob(const std::string& path) {
  v1::Job job;
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;  // Of a newer program.
  const auto status = google::protobuf::util::JsonStringToMessage(ReadText(path), &job, options);
  if (!status.ok() || job.name().empty()) {
    throw Failure(ExitCode::kInvalidScenario,
                  fmt::format("{}: holds no job as describe -o json prints it{}{}", path,
                              status.ok() ? "" : ": ", std::string(status.message())));
  }
  return job;
}

}  // namespace

v1::Job GetJob(Client& client, const std::string& job) {
  v1::GetJobRequest request;
  request.set_name(JobName(job));
  return client.Call(&Client::Stub::GetJob, request);
}

v1::Job GetSweep(Client& client, const std::string& job) {
  v1::Job sweep = GetJob(client, job);
  if (sweep.has_sweep()) return sweep;
  throw Failure(ExitCode::kUsage,
                fmt::format("{} is no sweep; see contactctl describe", sweep.name()));
}

v1::Job JobSource::Get(const std::string& name) {
  if (std::filesystem::is_regular_file(name)) return ReadJob(name);
  if (!client_) client_.emplace(Connect(settings_));
  return GetJob(*client_, FindJob(*client_, name));
}

}  // namespace contact::cli
