#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "contact/v1/job_service.pb.h"
#include "jobs/job/callback.h"
#include "jobs/log/job_feed.h"
#include "jobs/log/stream_source.h"
#include "jobs/quota/message_bytes.h"
#include "jobs/quota/places.h"
#include "storage/store.h"

namespace contact {

/// Follows all jobs of a filter: a snapshot, page by page, then each job again when it has changed.
/// Headers are read from the store when they are wanted, so the newest is what is told, and nothing
/// but names is kept for a reader. A message without jobs comes whenever nothing was sent for the
/// bookmark interval.
///
/// Not thread-safe: one reader. Destroying it ends the watch.
class JobsCursor final : public StreamSource<v1::WatchJobsResponse> {
 public:
  /// Fills in what the store does not know of a running job.
  using Complete = std::function<void(StoredJob*)>;

  /// What the reader wants.
  struct Rules {
    /// The jobs to follow. Its `tenant`, `before` and `limit` are set by the cursor.
    JobQuery filter;
    /// Longest time without a message.
    std::chrono::milliseconds bookmark_interval{0};
    /// Whose jobs. Nobody has the empty one.
    std::string tenant = {};
    MessageBudget message_bytes = [] { return MessageBytes(1); };
  };

  /// `place` is kept until the cursor is destroyed. Store, feed and clock outlive the cursor.
  JobsCursor(Store& store, JobFeed& feed, const Clock& clock, Rules rules, Complete complete,
             Wake wake, Places::Place place);

  /// Ends with SLOW_WATCHER if more has changed than is kept in mind, and with STORE_FAILED if the
  /// store cannot read.
  StreamStep Read(v1::WatchJobsResponse* out) override;
  bool IsDue(std::chrono::steady_clock::time_point now) const override {
    return now - last_sent_ >= rules_.bookmark_interval;
  }

 private:
  /// What is on its way from the store; the store's thread puts it here.
  struct Fetch {
    Mutex mutex;
    bool done ABSL_GUARDED_BY(mutex) = false;
    absl::Status status ABSL_GUARDED_BY(mutex);
    /// Jobs found.
    JobPage page ABSL_GUARDED_BY(mutex);
    /// Names of jobs that are not there.
    std::vector<std::string> gone ABSL_GUARDED_BY(mutex);
  };

  /// The next message of jobs, without bookmarks.
  StreamStep ReadJobs(v1::WatchJobsResponse* out);
  /// Asks the store for the next page of the snapshot.
  void FetchPage();
  /// Asks the store for these jobs.
  void FetchChanged(const std::vector<std::string>& names);
  /// Wakes the reader once the store has answered all that was asked of it.
  void WakeWhenFetched();
  /// Makes a message of what was fetched, if it is there.
  StreamStep TakeFetched(v1::WatchJobsResponse* out);
  /// Has the next message keep to its bytes, if a job takes so many.
  void FitLimit(std::size_t job_bytes);
  bool HasState(const v1::Job& job) const;
  bool HasLabels(const v1::Job& job) const;

  Store& store_;
  const Clock& clock_;
  /// `filter.before` moves with the snapshot, `filter.limit` with the size of jobs.
  Rules rules_;
  const Complete complete_;
  /// Shared with the callbacks of the store, which may come after the cursor is destroyed.
  const std::shared_ptr<const Wake> wake_;
  const Places::Place place_;
  const std::shared_ptr<JobFeed::Reader> changes_;
  /// True once the snapshot is complete.
  bool listed_ = false;
  std::chrono::steady_clock::time_point last_sent_;
  /// Null while nothing is under way.
  std::shared_ptr<Fetch> fetch_;
};

}  // namespace contact
