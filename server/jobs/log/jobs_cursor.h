#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/log/job_feed.h"
#include "storage/store.h"

namespace contact {

/// Follows all jobs of a filter: a snapshot, page by page, then each job again when it has changed.
/// Headers are read from the store when they are wanted, so the newest is what is told, and nothing
/// but names is kept for a reader.
///
/// Not thread-safe: one reader. Destroying it ends the watch.
class JobsCursor {
 public:
  enum class Next {
    kMessage,  ///< `out` holds one.
    kWait,     ///< Nothing now; `wake` will be called.
    kSlow,     ///< More has changed than is kept in mind.
    kFailed,   ///< The store could not read; watch again.
  };

  /// Fills in what the store does not know of a running job.
  using Complete = std::function<void(StoredJob*)>;

  /// `wake` as for JobManager::Watch. `watchers` counts the cursors alive; the caller has counted
  /// this one already.
  JobsCursor(Store& store, JobFeed& feed, JobQuery filter, Complete complete,
             std::function<void()> wake, std::shared_ptr<std::atomic<int>> watchers);
  ~JobsCursor();
  JobsCursor(const JobsCursor&) = delete;
  JobsCursor& operator=(const JobsCursor&) = delete;

  /// Never blocks.
  Next Read(v1::WatchJobsResponse* out);

  /// True once the whole snapshot has been read.
  bool listed() const { return listed_; }

 private:
  /// What is on its way from the store; the store's thread puts it here.
  struct Fetch {
    Mutex mutex;
    bool done ABSL_GUARDED_BY(mutex) = false;
    absl::Status status ABSL_GUARDED_BY(mutex);
    JobPage page ABSL_GUARDED_BY(mutex);                   ///< Jobs found.
    std::vector<std::string> gone ABSL_GUARDED_BY(mutex);  ///< Names of jobs that are not there.
  };

  void FetchPage();
  void FetchChanged(const std::vector<std::string>& names);
  Next Take(v1::WatchJobsResponse* out);
  bool HasState(const v1::Job& job) const;
  bool HasLabels(const v1::Job& job) const;

  Store& store_;
  JobQuery filter_;  ///< `before` moves with the snapshot.
  const Complete complete_;
  const std::shared_ptr<const std::function<void()>> wake_;
  const std::shared_ptr<std::atomic<int>> watchers_;
  const std::shared_ptr<JobFeed::Reader> changes_;
  bool listed_ = false;  ///< The snapshot is complete.
  std::shared_ptr<Fetch> fetch_;
};

}  // namespace contact
