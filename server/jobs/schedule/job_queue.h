#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace contact {

/// The jobs that wait for a worker: larger priority first, of equals the one that came first.
class JobQueue {
 public:
  struct Job {
    std::string name;
    std::int32_t priority = 0;
    std::uint64_t number = 0;   ///< Order of coming.
    bool last_attempt = false;  ///< It was running when the server died, all times but one.
  };

  void Push(Job job) {
    const Place place{-job.priority, job.number};
    jobs_.insert_or_assign(place, std::move(job));
  }

  /// Takes the next job; if `careful`, the next that is not on its last attempt.
  std::optional<Job> Pop(bool careful) {
    const auto next = std::find_if(jobs_.begin(), jobs_.end(), [&](const auto& entry) {
      return !careful || !entry.second.last_attempt;
    });
    return Take(next);
  }

  /// Takes a job that does not wait any more.
  std::optional<Job> Remove(std::int32_t priority, std::uint64_t number) {
    return Take(jobs_.find({-priority, number}));
  }

  std::size_t size() const { return jobs_.size(); }

 private:
  using Place = std::tuple<std::int32_t, std::uint64_t>;
  using Jobs = std::map<Place, Job>;

  std::optional<Job> Take(Jobs::iterator place) {
    if (place == jobs_.end()) return std::nullopt;
    return std::move(jobs_.extract(place).mapped());
  }

  Jobs jobs_;
};

}  // namespace contact
