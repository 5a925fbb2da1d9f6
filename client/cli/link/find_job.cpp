#include "cli/link/find_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/scalar.h"
#include "cli/base/style.h"
#include "cli/link/job_names.h"

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

}  // namespace

std::string FindJob(Client& client, const std::string& text) {
  if (const auto steps = StepsBack(text)) return JobBeforeLast(client, *steps);
  const std::string name = JobName(text);
  const std::size_t letters = ShortName(name).size();
  return letters == 0 || letters >= kWholeId ? name : JobThatBegins(client, name);
}

}  // namespace contact::cli
