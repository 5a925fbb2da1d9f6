#pragma once

#include <string>

#include "base/executor.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/job/callback.h"
#include "jobs/job/job_options.h"
#include "jobs/read/page_tokens.h"
#include "jobs/schedule/unfinished.h"
#include "storage/store.h"

namespace contact {

/// Answers what jobs are: reads them from the store, and adds what only those who run them and
/// the settings know. Jobs of other tenants than the caller's are not there. Thread-safe; no call
/// waits.
class JobReader {
 public:
  /// All outlive it. Results are parsed on the executor, because a ledger may be long.
  JobReader(Store& store, const JobOptions& options, const Unfinished& unfinished,
            Executor& executor)
      : store_(store),
        options_(options),
        unfinished_(unfinished),
        executor_(executor),
        tokens_(options.page_secret) {}

  /// The job with ledger and artifacts; of a running job, what its run has brought so far.
  void Get(const Principal& caller, const std::string& name, Callback<v1::Job> done) const;
  /// A page of job headers, newest first.
  void List(const Principal& caller, const v1::ListJobsRequest& request,
            Callback<v1::ListJobsResponse> done) const;

  /// Adds to a stored header what is not stored, or that it is damaged.
  void Complete(StoredJob* stored) const;
  /// Answers with all of a stored job. To be called on the store's thread.
  void Answer(StoredJob stored, Callback<v1::Job> done) const;

 private:
  Store& store_;
  const JobOptions& options_;
  const Unfinished& unfinished_;
  Executor& executor_;
  const PageTokens tokens_;
};

}  // namespace contact
