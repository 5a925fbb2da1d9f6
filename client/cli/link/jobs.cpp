#include "cli/link/jobs.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/ids.h"
#include "base/spelling.h"
#include "cli/base/files.h"
#include "cli/base/number.h"
#include "cli/base/scalar.h"
#include "cli/base/style.h"
#include "cli/link/connect.h"

namespace contact::cli {
namespace {

constexpr std::size_t kWholeId = 10;  // Characters of the IDs that a server gives.
constexpr int kMostSteps = 999;       // One page of a list has so many jobs and one more.

// N of `last~N`, 0 for `last`; none for another text.
std::optional<int> StepsBack(std::string_view text) {
  constexpr std::string_view kLast = "last";
  if (text == kLast) return 0;
  if (!text.starts_with("last~")) return std::nullopt;
  const auto steps = ParseInteger<int>(text.substr(kLast.size() + 1));
  if (steps && *steps >= 0 && *steps <= kMostSteps) return steps;
  throw Failure(ExitCode::kUsage,
                fmt::format("{}: N of last~N is a whole number from 0 to {}", text, kMostSteps));
}

// The job that is so many before the newest one.
std::string JobBeforeLast(Client& client, int steps) {
  v1::ListJobsRequest request;
  request.set_page_size(steps + 1);
  const v1::ListJobsResponse newest = client.Call(&Client::Stub::ListJobs, request);
  if (newest.jobs_size() > steps) return newest.jobs(steps).name();
  throw Failure(ExitCode::kNotFound,
                newest.jobs_size() == 0
                    ? "the server has no jobs"
                    : fmt::format("there is no last~{}: the server has {}", steps,
                                  Count(newest.jobs_size(), "job", "jobs")));
}

// Why a beginning names no job: a line for each that it may mean.
std::string Ambiguous(const std::string& begin, const v1::ListJobsResponse& found) {
  std::string text = fmt::format("several jobs begin with '{}':", ShortName(begin));
  for (const v1::Job& job : found.jobs()) {
    text += fmt::format("\n  {}  {}  {}{}{}", ShortName(job.name()), Instant(job.create_time()),
                        v1::Job::State_Name(job.state()), job.title().empty() ? "" : "  ",
                        OneLine(job.title()));
  }
  return text + (found.next_page_token().empty() ? "" : "\n  … and more");
}

// The one job whose name begins so; `begin` itself if there is none.
std::string JobThatBegins(Client& client, const std::string& begin) {
  constexpr int kMostCandidates = 10;
  v1::ListJobsRequest request;
  request.set_name_prefix(begin);
  request.set_page_size(kMostCandidates);
  v1::ListJobsResponse found = client.Call(&Client::Stub::ListJobs, request);
  const auto is_other = [&begin](const v1::Job& job) { return !job.name().starts_with(begin); };
  auto& jobs = *found.mutable_jobs();  // A server of an earlier version answers with all jobs.
  jobs.erase(std::remove_if(jobs.begin(), jobs.end(), is_other), jobs.end());
  if (jobs.empty() || std::ranges::find(jobs, begin, &v1::Job::name) != jobs.end()) return begin;
  if (jobs.size() == 1) return jobs[0].name();
  throw Failure(ExitCode::kUsage, Ambiguous(begin, found));
}

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

std::string JobName(const std::string& job) {
  return job.starts_with("jobs/") ? job : "jobs/" + job;
}

std::string ShortName(const std::string& name) {
  constexpr std::string_view kCollection = "jobs/";
  return name.starts_with(kCollection) ? name.substr(kCollection.size()) : name;
}

std::string RandomRequestId() { return RandomIds().NextUuid(); }

std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts) {
  return ParseAssignments(texts, "--label", "KEY=VALUE");
}

std::string FindJob(Client& client, const std::string& text) {
  if (const auto steps = StepsBack(text)) return JobBeforeLast(client, *steps);
  const std::string name = JobName(text);
  const std::size_t letters = ShortName(name).size();
  return letters == 0 || letters >= kWholeId ? name : JobThatBegins(client, name);
}

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
  if (name.find('.') != std::string::npos) {  // No ID has one.
    throw Failure(ExitCode::kLocal, fmt::format("there is no file {}", name));
  }
  if (!client_) client_.emplace(Connect(settings_));
  return GetJob(*client_, FindJob(*client_, name));
}

}  // namespace contact::cli
