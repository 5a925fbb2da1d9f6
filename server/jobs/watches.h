#pragma once

#include <chrono>
#include <memory>

#include "base/clock.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/job/callback.h"
#include "jobs/job_reader.h"
#include "jobs/log/job_feed.h"
#include "jobs/log/log_cursor.h"
#include "jobs/log/stream_source.h"
#include "jobs/log/tail_cursor.h"
#include "jobs/quota/message_bytes.h"
#include "jobs/quota/places.h"
#include "jobs/read/watch_rules.h"
#include "jobs/schedule/unfinished.h"

namespace contact {

/// A job that is watched.
struct WatchedJob {
  /// The job when the watch began, without ledger.
  v1::Job snapshot;
  /// Reads its log. Must not outlive the store.
  std::unique_ptr<LogCursor> cursor;
  /// Longest time without a sequence to resume from.
  std::chrono::milliseconds bookmark_interval{0};
  /// True if the cursor may have something new because time has passed.
  bool paced = false;
  MessageBudget message_bytes = [] { return MessageBytes(1); };
};

/// Opens watches of one job and of all jobs. Thread-safe; no call waits.
class Watches {
 public:
  /// What is needed. All of it outlives the watches.
  struct Parts {
    /// The store, and who decodes what watchers read from it.
    EventSource source;
    const Clock& clock;
    Unfinished& unfinished;
    const JobReader& reader;
    JobFeed& feed;
    /// The places of watchers.
    Places watchers;
  };
  explicit Watches(Parts parts) : parts_(std::move(parts)) {}

  /// Opens a cursor over the log of a job of the caller's tenant.
  void WatchJob(const Principal& caller, const v1::WatchJobRequest& request, Wake wake,
                Callback<WatchedJob> done);

  /// Opens a source of the headers of all jobs of the caller's tenant that match a filter, and of
  /// their changes.
  using Jobs = std::unique_ptr<StreamSource<v1::WatchJobsResponse>>;
  Result<Jobs> WatchJobs(const Principal& caller, const v1::WatchJobsRequest& request, Wake wake);

 private:
  /// Opens the watch of a stored job, which has the uid that the request expects.
  WatchedJob Open(const v1::WatchJobRequest& request, WatchRules rules, StoredJob stored, Wake wake,
                  Places::Place place);

  const Parts parts_;
};

}  // namespace contact
