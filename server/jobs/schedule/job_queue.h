#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace contact {

/// The jobs that wait for a worker: larger priority first, of equals the one that came first. Not
/// thread-safe.
class JobQueue {
 public:
  /// Adds a job. `number` counts the jobs in the order in which they came. `last_attempt`: it was
  /// running when the server died, all times but one.
  void Push(std::string name, std::int32_t priority, std::uint64_t number, bool last_attempt) {
    jobs_.insert_or_assign({-priority, number}, Job{std::move(name), last_attempt});
  }

  /// Takes the next job and returns its name; if `careful`, the next that is not on its last
  /// attempt. Nothing if there is none.
  std::optional<std::string> Pop(bool careful) {
    const auto next = std::ranges::find_if(
        jobs_, [&](const auto& entry) { return !careful || !entry.second.last_attempt; });
    if (next == jobs_.end()) return std::nullopt;
    return std::move(jobs_.extract(next).mapped().name);
  }

  /// Takes a job that does not wait any more. False: it has not waited.
  bool Remove(std::int32_t priority, std::uint64_t number) {
    return jobs_.erase({-priority, number}) > 0;
  }

  std::size_t size() const { return jobs_.size(); }

 private:
  struct Job {
    std::string name;
    bool last_attempt;
  };
  /// By negative priority and number.
  std::map<std::pair<std::int32_t, std::uint64_t>, Job> jobs_;
};

}  // namespace contact
