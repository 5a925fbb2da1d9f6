#include "jobs/log/jobs_cursor.h"

#include <algorithm>
#include <utility>

namespace contact {
namespace {

// Jobs in a message: headers of a few hundred bytes each.
constexpr int kMostJobs = 100;

}  // namespace

JobsCursor::JobsCursor(Store& store, JobFeed& feed, JobQuery filter, Complete complete,
                       std::function<void()> wake, std::shared_ptr<std::atomic<int>> watchers)
    : store_(store),
      filter_(std::move(filter)),
      complete_(std::move(complete)),
      wake_(std::make_shared<const std::function<void()>>(std::move(wake))),
      watchers_(std::move(watchers)),
      changes_(feed.Subscribe(*wake_)) {  // Before the snapshot, so that nothing falls between.
  filter_.limit = kMostJobs;
}

JobsCursor::~JobsCursor() { --*watchers_; }

JobsCursor::Next JobsCursor::Read(v1::WatchJobsResponse* out) {
  for (;;) {
    if (changes_->overflown()) return Next::kSlow;
    if (fetch_) {
      const bool snapshot = !listed_;
      const Next next = Take(out);
      if (next != Next::kMessage || snapshot || out->jobs_size() + out->gone_size() > 0) {
        return next;
      }
    }
    if (!listed_) {
      FetchPage();
      continue;
    }
    const std::vector<std::string> names = changes_->Take(kMostJobs);
    if (names.empty()) return Next::kWait;
    FetchChanged(names);
  }
}

void JobsCursor::FetchPage() {
  fetch_ = std::make_shared<Fetch>();
  const std::weak_ptr<Fetch> weak = fetch_;  // Gone if the reader leaves first.
  store_.List(filter_, [weak, wake = wake_](absl::StatusOr<JobPage> page) {
    const auto fetch = weak.lock();
    if (!fetch) return;
    {
      const MutexLock lock(fetch->mutex);
      fetch->done = true;
      fetch->status = page.status();
      if (page.ok()) fetch->page = *std::move(page);
    }
    (*wake)();
  });
}

void JobsCursor::FetchChanged(const std::vector<std::string>& names) {
  fetch_ = std::make_shared<Fetch>();
  const std::weak_ptr<Fetch> weak = fetch_;
  for (const std::string& name : names) {
    store_.Read(name, JobPart::kHeader, [weak, name](absl::StatusOr<StoredJob> stored) {
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
  store_.Flush([weak, wake = wake_] {
    const auto fetch = weak.lock();
    if (!fetch) return;
    {
      const MutexLock lock(fetch->mutex);
      fetch->done = true;
    }
    (*wake)();
  });
}

JobsCursor::Next JobsCursor::Take(v1::WatchJobsResponse* out) {
  JobPage page;
  {
    const MutexLock lock(fetch_->mutex);
    if (!fetch_->done) return Next::kWait;
    if (!fetch_->status.ok()) return Next::kFailed;
    page = std::move(fetch_->page);
    out->mutable_gone()->Add(fetch_->gone.begin(), fetch_->gone.end());
  }
  fetch_ = nullptr;
  for (StoredJob& stored : page.jobs) {
    if (!HasLabels(stored.job)) continue;
    if (HasState(stored.job)) {
      complete_(&stored);
      *out->add_jobs() = std::move(stored.job);
    } else {
      out->add_gone(stored.job.name());
    }
  }
  filter_.before = page.next;
  listed_ |= page.next == 0;
  out->set_snapshot_complete(listed_);
  return Next::kMessage;
}

bool JobsCursor::HasState(const v1::Job& job) const {
  return filter_.states.empty() ||
         std::ranges::find(filter_.states, job.state()) != filter_.states.end();
}

bool JobsCursor::HasLabels(const v1::Job& job) const {
  return std::ranges::all_of(filter_.labels, [&job](const auto& label) {
    const auto found = job.labels().find(label.first);
    return found != job.labels().end() && found->second == label.second;
  });
}

}  // namespace contact
