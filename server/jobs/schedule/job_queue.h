#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "jobs/schedule/fair_order.h"

namespace contact {

/// Whose a job is.
struct Share {
  std::string tenant;
  std::string owner;
};

/// The jobs that wait for a worker. Tenants that have jobs get the same worker time, and so do the
/// owners of one tenant. Of the jobs of one owner larger priority goes first, of equals the one
/// that came first. Not thread-safe.
class JobQueue {
 public:
  /// At most `most_running` jobs of one owner run at a time; 0: any number.
  explicit JobQueue(int most_running = 0) : most_running_(most_running) {}

  /// Adds a job. `number` counts the jobs in the order in which they came. `last_attempt`: it was
  /// running when the server died, all times but one.
  void Push(const Share& share, std::string name, std::int32_t priority, std::uint64_t number,
            bool last_attempt);

  /// Takes the next job and returns its name; if `careful`, the next that is not on its last
  /// attempt. Nothing if there is none. It counts as running from `now` [s] until Ended.
  std::optional<std::string> Pop(bool careful, double now);

  /// True if Pop has one.
  bool ready(bool careful) const { return First(careful).has_value(); }
  /// As Pop, for this job alone. False: it has not waited.
  bool Take(const Share& share, std::int32_t priority, std::uint64_t number, double now);

  /// A job that was popped runs no more.
  void Ended(const Share& share, double now);

  /// By how much worker time [s] the owner of a running job is ahead of the next that waits, if
  /// that is another; negative if he is behind.
  std::optional<double> Ahead(const Share& share, bool careful, double now);

  /// Takes a job that does not wait any more. False: it has not waited.
  bool Remove(const Share& share, std::int32_t priority, std::uint64_t number);

  std::size_t size() const { return size_; }

 private:
  struct Job {
    std::string name;
    bool last_attempt;
  };
  /// By negative priority and number.
  using Jobs = std::map<std::pair<std::int32_t, std::uint64_t>, Job>;
  struct Tenant {
    FairOrder order;
    /// By owner; none is empty.
    std::map<std::string, Jobs> owners;
  };
  /// A job that may be next.
  struct Candidate {
    Share share;
    Jobs::const_iterator job;
    /// Of the tenant, then of the owner, then when it came.
    double tenant_rank, owner_rank;
    std::uint64_t number;

    bool Before(const Candidate& other) const {
      return std::tie(tenant_rank, owner_rank, number) <
             std::tie(other.tenant_rank, other.owner_rank, other.number);
    }
  };

  // The job that is next of all.
  std::optional<Candidate> First(bool careful) const;
  // Takes a job out of those that wait; they are not left with an empty list.
  std::string Extract(const Share& share, Jobs::const_iterator job);
  // What the order of an owner's jobs says is next, if he may have a worker more.
  std::optional<Candidate> Next(const std::string& tenant, const std::string& owner,
                                const Jobs& jobs, bool careful) const;
  // Nothing if it does not wait.
  std::optional<Jobs::const_iterator> Find(const Share& share, std::int32_t priority,
                                           std::uint64_t number) const;
  // A worker begins to run a job.
  void Begin(const Share& share);
  // A job neither waits nor runs any more.
  void Leave(const Share& share);
  // Time has passed for those whose jobs run.
  void Pass(double now);

  const int most_running_;
  FairOrder order_;
  std::map<std::string, Tenant> tenants_;
  std::size_t size_ = 0;
  double now_ = 0;
};

}  // namespace contact
