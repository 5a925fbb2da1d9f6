#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "base/clock.h"
#include "base/executor.h"
#include "base/ids.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/job/callback.h"
#include "jobs/job/job_options.h"
#include "jobs/job_reader.h"
#include "jobs/quota/quotas.h"
#include "jobs/schedule/unfinished.h"
#include "storage/store.h"

namespace contact {

/// Takes jobs in: checks them, stores them, and hands them to those who run them. Thread-safe; no
/// call waits.
class JobCreator {
 public:
  /// What a creator needs. All of it outlives the creator.
  struct Parts {
    Store& store;
    const Clock& clock;
    IdSource& ids;
    const JobOptions& options;
    Unfinished& unfinished;
    Quotas& quotas;
    /// Answers requests that were accepted before.
    const JobReader& reader;
    /// Checks scenarios, which takes too long for the callers' threads.
    Executor& executor;
  };
  explicit JobCreator(const Parts& parts) : parts_(parts) {}

  /// Checks and stores a job of the caller; `done` gets it in state QUEUED. A request with a
  /// `request_id` that was used before by the tenant gets the job of that request.
  void Create(const Principal& caller, v1::CreateJobRequest request, Callback<v1::Job> done,
              Abandoned abandoned = {});

  /// Refuses new jobs with SERVER_DRAINING from now on.
  void Drain() { draining_ = true; }

 private:
  /// One CreateJob on its way: it is checked, then stored. Every step may refuse it.
  struct Creation;

  /// Takes a place in the queue and of the owner's jobs; why not, if it cannot.
  std::optional<Error> Reserve(const Principal& caller, Creation* creation) const;
  /// Takes what only the checked job tells, and looks whether the disk has room.
  std::optional<Error> Admit(Creation* creation, std::int64_t cells) const;
  /// Checks the request. On the executor.
  void Check(const std::shared_ptr<Creation>& creation) const;
  /// Gives the job its name and stores it.
  void Commit(const std::shared_ptr<Creation>& creation) const;
  /// Queues the stored job and answers with it. On the store's thread.
  void Accept(Creation& creation, StoredJob stored) const;
  /// Answers with an error, and gives back what was taken.
  void Refuse(Creation& creation, Error error) const;
  /// Gives back what was taken for the job.
  void GiveBack(Creation* creation) const;
  /// What a refusal of the store means.
  Error ErrorOf(const absl::Status& status, const Creation& creation) const;

  const Parts parts_;
  std::atomic<bool> draining_ = false;
};

}  // namespace contact
