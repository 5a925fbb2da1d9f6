#include "jobs/log/jobs_cursor.h"

#include <algorithm>
#include <utility>

namespace contact {
namespace {

// Jobs in a message.
constexpr int kMostJobs = 100;
// Bytes that the header of a job has if it has many labels and a long note. A few hundred are
// usual: the first message finds out.
constexpr std::size_t kLargeJob = 8 << 10;

}  // namespace

JobsCursor::JobsCursor(Store& store, JobFeed& feed, const Clock& clock, Rules rules,
                       Complete complete, Wake wake, Places::Place place)
    : store_(store),
      clock_(clock),
      rules_(std::move(rules)),
      complete_(std::move(complete)),
      wake_(std::make_shared<const Wake>(std::move(wake))),
      place_(std::move(place)),
      // Before the snapshot, so that nothing falls between.
      changes_(feed.Subscribe(rules_.tenant, *wake_)),
      last_sent_(clock.Elapsed()) {
  rules_.filter.tenant = rules_.tenant;
  FitLimit(kLargeJob);
}

StreamStep JobsCursor::Read(v1::WatchJobsResponse* out) {
  const auto now = clock_.Elapsed();
  StreamStep step = ReadJobs(out);
  if (!step.has_message && !step.error && IsDue(now)) {
    out->set_snapshot_complete(listed_);
    step.has_message = true;
  }
  if (step.has_message) last_sent_ = now;
  return step;
}

StreamStep JobsCursor::ReadJobs(v1::WatchJobsResponse* out) {
  for (;;) {
    if (changes_->overflown()) return {.error = SlowWatcher("jobs")};
    if (fetch_) {
      const bool snapshot = !listed_;
      StreamStep step = TakeFetched(out);
      if (!step.has_message || snapshot || out->jobs_size() + out->gone_size() > 0) return step;
    }
    if (!listed_) {
      FetchPage();
      continue;
    }
    const std::vector<std::string> names =
        changes_->Take(static_cast<std::size_t>(rules_.filter.limit));
    if (names.empty()) return {};
    FetchChanged(names);
  }
}

void JobsCursor::FetchPage() {
  fetch_ = std::make_shared<Fetch>();
  // Gone if the reader leaves first.
  const std::weak_ptr<Fetch> weak = fetch_;
  JobQuery query = rules_.filter;
  query.abandoned = [weak] { return weak.expired(); };
  store_.List(std::move(query), [weak](absl::StatusOr<JobPage> page) {
    const auto fetch = weak.lock();
    if (!fetch) return;
    const MutexLock lock(fetch->mutex);
    fetch->status = page.status();
    if (page.ok()) fetch->page = *std::move(page);
  });
  WakeWhenFetched();
}

void JobsCursor::FetchChanged(const std::vector<std::string>& names) {
  fetch_ = std::make_shared<Fetch>();
  for (const std::string& name : names) {
    store_.ReadOf(rules_.tenant, name, JobPart::kHeader,
                  [weak = std::weak_ptr(fetch_), name](absl::StatusOr<StoredJob> stored) {
                    const auto fetch = weak.lock();
                    if (!fetch) return;
                    const MutexLock lock(fetch->mutex);
                    if (stored.ok()) {
                      fetch->page.jobs.push_back(*std::move(stored));
                    } else if (absl::IsNotFound(stored.status())) {
                      fetch->gone.push_back(name);
                    } else if (!absl::IsDataLoss(stored.status())) {
                      fetch->status = stored.status();
                    }
                  });
  }
  WakeWhenFetched();
}

void JobsCursor::WakeWhenFetched() {
  store_.Flush([weak = std::weak_ptr(fetch_), wake = wake_] {
    const auto fetch = weak.lock();
    if (!fetch) return;
    {
      const MutexLock lock(fetch->mutex);
      fetch->done = true;
    }
    (*wake)();
  });
}

StreamStep JobsCursor::TakeFetched(v1::WatchJobsResponse* out) {
  JobPage page;
  {
    const MutexLock lock(fetch_->mutex);
    if (!fetch_->done) return {};
    if (!fetch_->status.ok()) return {.error = Unreadable("jobs")};
    page = std::move(fetch_->page);
    out->mutable_gone()->Add(fetch_->gone.begin(), fetch_->gone.end());
  }
  fetch_ = nullptr;
  for (StoredJob& stored : page.jobs) {
    if (HasState(stored.job) && HasLabels(stored.job)) {
      complete_(&stored);
      *out->add_jobs() = std::move(stored.job);
    } else {
      out->add_gone(stored.job.name());
    }
  }
  if (out->jobs_size() > 0) {
    FitLimit(out->ByteSizeLong() / static_cast<std::size_t>(out->jobs_size()));
  }
  rules_.filter.before = page.next;
  listed_ |= page.next == 0;
  out->set_snapshot_complete(listed_);
  return {.has_message = true};
}

void JobsCursor::FitLimit(std::size_t job_bytes) {
  const std::size_t jobs = rules_.message_bytes() / std::max<std::size_t>(job_bytes, 1);
  rules_.filter.limit = static_cast<int>(std::clamp<std::size_t>(jobs, 1, kMostJobs));
}

bool JobsCursor::HasState(const v1::Job& job) const {
  return rules_.filter.states.empty() ||
         std::ranges::find(rules_.filter.states, job.state()) != rules_.filter.states.end();
}

bool JobsCursor::HasLabels(const v1::Job& job) const {
  return std::ranges::all_of(rules_.filter.labels, [&job](const auto& label) {
    const auto found = job.labels().find(label.first);
    return found != job.labels().end() && found->second == label.second;
  });
}

}  // namespace contact
