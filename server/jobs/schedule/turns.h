#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "jobs/schedule/job_queue.h"

namespace contact {

/// Who computes: at most so many jobs at once as there are workers. The others wait for their turn,
/// in the order of a JobQueue: jobs that have not begun, and runs that were asked to let another
/// compute and keep their threads meanwhile. Time is given in seconds of any clock. Not
/// thread-safe.
class Turns {
 public:
  /// `most_running`: see JobQueue.
  Turns(int workers, int most_running) : workers_(workers), queue_(most_running) {}

  /// A job, and where it stands among those of its owner.
  struct Job {
    Share share;
    std::string name;
    std::int32_t priority = 0;
    /// Counts the jobs in the order in which they came.
    std::uint64_t number = 0;
    /// See JobQueue::Push.
    bool last_attempt = false;
  };

  /// A job comes.
  void Add(const Job& job);
  /// A job goes that has not begun. False: it has.
  bool Remove(const Job& job);
  /// Number of jobs that have not begun.
  int waiting() const { return static_cast<int>(queue_.size()) - parked_; }

  /// True if a job waits that Take would have if a worker were free.
  bool ready(bool careful) const { return queue_.ready(careful); }
  /// The job that computes from now on; nothing if no worker is free or none waits.
  struct Next {
    std::string name;
    /// It has begun before, and goes on.
    bool parked;
  };
  /// `careful`: see JobQueue::Pop.
  std::optional<Next> Take(bool careful, double now);
  /// A job that computes ends. False: it has ended before.
  bool End(const std::string& name, double now);

  /// One more run that is to let another compute; nothing if all is fair. A run is told once until
  /// it does so: one that cannot yield for long does not stand in for the others.
  std::optional<std::string> ToYield(bool careful, double now);
  /// It does so: it waits again, until Take has it.
  void Park(const std::string& name, double now);
  /// It goes on at once, to come to its end, even if no worker is free.
  void Unpark(const std::string& name, double now);
  /// True while it waits.
  bool parked(const std::string& name) const;

  /// True if no worker is busy.
  bool idle() const { return busy_ <= 0; }
  /// Takes a free worker for something that is no job. False: there is none.
  bool Borrow();
  void GiveBack(int workers = 1) { busy_ -= workers; }

 private:
  struct Run {
    Job job;
    /// It waits for its turn again.
    bool parked = false;
    /// ToYield has named it.
    bool told = false;
  };

  const int workers_;
  JobQueue queue_;
  /// Jobs that wait and have not begun, by name.
  std::map<std::string, Job> jobs_;
  /// Jobs that have begun, by name.
  std::map<std::string, Run> runs_;
  int parked_ = 0;
  int busy_ = 0;
};

}  // namespace contact
