#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/mutex.h"

namespace contact {

/// Tells those who watch all jobs of a tenant which of them have changed. Thread-safe.
class JobFeed {
 public:
  /// Past it a reader has lost its place: what it has not looked at may cost no more memory.
  static constexpr std::size_t kMostChanges = 10'000;

  /// Names of jobs that one reader has not looked at since they changed.
  class Reader {
   public:
    Reader(std::string tenant, std::function<void()> wake)
        : tenant_(std::move(tenant)), wake_(std::move(wake)) {}

    /// Takes some of the names, `most` at most. If there are none, `wake` is called once there are.
    std::vector<std::string> Take(std::size_t most);
    /// True if there were too many names.
    bool overflown() const;

   private:
    friend class JobFeed;
    /// Notes a change, and wakes the reader if it waits.
    void Add(const std::string& name);

    /// It hears of the jobs of this tenant.
    const std::string tenant_;
    const std::function<void()> wake_;
    mutable Mutex mutex_;
    /// Empty once overflown_.
    std::set<std::string> names_ ABSL_GUARDED_BY(mutex_);
    bool overflown_ ABSL_GUARDED_BY(mutex_) = false;
    /// True if the last Take found nothing, and `wake` was not called since.
    bool waiting_ ABSL_GUARDED_BY(mutex_) = true;
  };

  /// Hears of changes of the tenant's jobs from now on, until the reader is destroyed.
  std::shared_ptr<Reader> Subscribe(std::string tenant, std::function<void()> wake);

  /// True if there are readers.
  bool watched();

  /// A job of the tenant was created, changed its state, labels or note, or was deleted; and that
  /// is stored.
  void Changed(const std::string& tenant, const std::string& name);

 private:
  Mutex mutex_;
  /// May hold readers that are gone.
  std::vector<std::weak_ptr<Reader>> readers_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
