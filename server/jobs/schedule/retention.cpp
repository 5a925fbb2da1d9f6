#include "jobs/schedule/retention.h"

#include <absl/status/statusor.h>
#include <google/protobuf/util/time_util.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "base/clock.h"
#include "base/future.h"
#include "jobs/job/lifecycle.h"
#include "jobs/log/job_feed.h"
#include "storage/store.h"

namespace contact {
namespace {

using google::protobuf::util::TimeUtil;

constexpr std::chrono::minutes kPeriod{1};
constexpr int kPage = 200;
// Jobs that may go at once for their age, however few there are.
constexpr std::size_t kFew = 10;

absl::StatusOr<JobPage> ReadPage(Store& store, std::int64_t before) {
  return Await<absl::StatusOr<JobPage>>([&](auto done) {
    store.List({.states = {v1::Job::SUCCEEDED, v1::Job::FAILED, v1::Job::CANCELLED},
                .before = before,
                .limit = kPage},
               std::move(done));
  });
}

std::unordered_map<std::string, std::int64_t> ReadBytes(Store& store) {
  std::unordered_map<std::string, std::int64_t> bytes;
  const auto read =
      Await<absl::StatusOr<std::vector<JobSize>>>([&](auto done) { store.Sizes(std::move(done)); });
  if (!read.ok()) return bytes;
  for (const JobSize& size : *read) bytes.emplace(size.name, size.bytes);
  return bytes;
}

}  // namespace

std::optional<WallTime> ExpiryOf(const v1::Job& job, const RetentionLimits& limits) {
  if (!IsFinal(job.state()) || !job.has_end_time()) return std::nullopt;
  std::chrono::nanoseconds kept(TimeUtil::DurationToNanoseconds(job.time_to_live()));
  if (kept.count() == 0) kept = limits.age;
  if (kept.count() == 0) return std::nullopt;
  const std::chrono::nanoseconds end(TimeUtil::TimestampToNanoseconds(job.end_time()));
  return WallTime(std::chrono::duration_cast<WallTime::duration>(end + kept));
}

bool IsToCompact(const v1::Job& job, WallTime now, const RetentionLimits& limits) {
  if (limits.compact_after.count() == 0 || !IsFinal(job.state())) return false;
  const std::chrono::nanoseconds end(TimeUtil::TimestampToNanoseconds(job.end_time()));
  return end + limits.compact_after <= now.time_since_epoch();
}

void SetExpireTime(const RetentionLimits& limits, v1::Job* job) {
  const auto expiry = ExpiryOf(*job, limits);
  if (!expiry) return;
  *job->mutable_expire_time() = ToTimestamp(*expiry);
}

std::vector<std::string> Expired(const std::vector<EndedJob>& jobs, WallTime now,
                                 const RetentionLimits& limits) {
  std::size_t left = std::max(kFew, jobs.size() / 10);  // May still go for their age.
  std::int64_t kept = 0;
  std::vector<std::string> expired;
  for (const EndedJob& job : jobs) {
    const bool old = job.expiry && *job.expiry <= now;
    if (!old) kept += job.bytes;
    if (!old || (!job.asked && left == 0)) continue;
    expired.push_back(job.name);
    if (!job.asked) --left;
  }
  if (limits.bytes == 0) return expired;
  for (auto job = jobs.begin(); job != jobs.end() && kept > limits.bytes; ++job) {
    if (job->expiry && *job->expiry <= now) continue;
    expired.push_back(job->name);
    kept -= job->bytes;
  }
  return expired;
}

Retention::Retention(Store& store, const Clock& clock, RetentionLimits limits, JobFeed& feed)
    : store_(store), clock_(clock, limits.clock_file), limits_(std::move(limits)), feed_(feed) {}

Retention::~Retention() { Stop(); }

void Retention::Start() {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "retention");
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any never;
    while (!stopped()) {
      const int deleted = Purge();
      if (deleted > 0) spdlog::info("deleted {} expired jobs", deleted);
      never.wait_for(lock, stop_.get_token(), kPeriod, [] { return false; });
    }
  });
}

void Retention::Stop() {
  stop_.request_stop();
  if (thread_.joinable()) thread_.join();
}

int Retention::Purge() {
  const WallTime now = clock_.Now();
  const std::vector<EndedJob> jobs = ListEnded(now);
  const int deleted = Delete(jobs, now);
  Compact(jobs);
  return deleted;
}

// An error means in both that another call has deleted the job meanwhile.
int Retention::Delete(const std::vector<EndedJob>& jobs, WallTime now) {
  int deleted = 0;
  for (const std::string& name : Expired(jobs, now, limits_)) {
    if (stopped()) break;
    const auto done = Await<absl::StatusOr<JobOwner>>(
        [&](auto callback) { store_.Delete(name, "", std::move(callback)); });
    if (!done.ok()) continue;
    feed_.Changed(done->tenant, name);
    ++deleted;
  }
  return deleted;
}

void Retention::Compact(const std::vector<EndedJob>& jobs) {
  for (const EndedJob& job : jobs) {
    if (stopped()) break;
    if (!job.to_compact) continue;
    const auto done = Await<absl::StatusOr<JobOwner>>(
        [&](auto callback) { store_.Compact(job.name, std::move(callback)); });
    if (done.ok()) feed_.Changed(done->tenant, job.name);
  }
}

std::vector<EndedJob> Retention::ListEnded(WallTime now) {
  std::vector<std::pair<std::int64_t, EndedJob>> found;
  const auto bytes =
      limits_.bytes > 0 ? ReadBytes(store_) : std::unordered_map<std::string, std::int64_t>();
  std::int64_t before = 0;
  do {
    const absl::StatusOr<JobPage> page = ReadPage(store_, before);
    if (!page.ok()) break;
    for (const StoredJob& stored : page->jobs) {
      const v1::Job& job = stored.job;
      const auto size = bytes.find(job.name());
      found.push_back(
          {TimeUtil::TimestampToNanoseconds(job.end_time()),
           {job.name(), ExpiryOf(job, limits_), size == bytes.end() ? 0 : size->second,
            !stored.compacted && IsToCompact(job, now, limits_), job.has_time_to_live()}});
    }
    before = page->next;
  } while (before > 0 && !stopped());
  std::ranges::stable_sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<EndedJob> jobs;
  jobs.reserve(found.size());
  for (auto& [end, job] : found) jobs.push_back(std::move(job));
  return jobs;
}

}  // namespace contact
