#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <string>

namespace contact {

/// Who of several is to have the next worker, so that all who have jobs get the same worker time:
/// start-time fair queueing (Goyal, Vin, Cheng 1996). One that comes, or comes back, begins with
/// the time of the least of those who are there: it cannot save time up. Not thread-safe.
class FairOrder {
 public:
  /// A job of `who` comes, to wait for a worker and then to run; Leave is called for each Join.
  void Join(const std::string& who) {
    const double least = Least();
    Member& member = members_[who];
    if (member.jobs++ == 0 && least < kNever) member.time = std::max(member.time, least);
  }
  /// A job of `who` has ended, or waits no more.
  void Leave(const std::string& who) {
    --members_.at(who).jobs;
    // One whose time is not above the least would begin with the same anyway.
    const double least = Least();
    std::erase_if(members_, [least](const auto& entry) {
      return entry.second.jobs == 0 && entry.second.time <= least;
    });
  }

  /// A worker begins to run a job of `who`.
  void Begin(const std::string& who) { ++members_.at(who).running; }
  /// It has ended that.
  void End(const std::string& who) { --members_.at(who).running; }
  /// So much time has passed [s]: all that run have used it.
  void Pass(double seconds) {
    for (auto& [who, member] : members_) member.time += seconds * member.running;
  }

  /// The lower, the sooner `who` is to have a worker. A job that runs counts for a second that it
  /// will use, or all workers that are free at once would go to one.
  double Rank(const std::string& who) const {
    const Member& member = members_.at(who);
    return member.time + kAhead * member.running;
  }
  /// True if nobody has jobs, nor time to remember.
  bool empty() const { return members_.empty(); }
  /// Number of workers that run jobs of `who`.
  int running(const std::string& who) const {
    const auto found = members_.find(who);
    return found == members_.end() ? 0 : found->second.running;
  }

  /// What Rank adds for each job that runs [s].
  static constexpr double kAhead = 1;

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  struct Member {
    /// Of jobs that wait or run.
    int jobs = 0;
    int running = 0;
    /// Worker time used, and what it was given when it came [s].
    double time = 0;
  };

  // The least time of those that have jobs; kNever if nobody has.
  double Least() const {
    double least = kNever;
    for (const auto& [who, member] : members_) {
      if (member.jobs > 0) least = std::min(least, member.time);
    }
    return least;
  }

  std::map<std::string, Member> members_;
};

}  // namespace contact
