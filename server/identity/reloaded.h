#pragma once

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/mutex.h"

namespace contact {

/// A value that is read from files, and read again when they have changed. A change that cannot be
/// used keeps the old value and is told once. `value` is thread-safe; Look belongs to one thread.
template <class T>
class Reloaded {
 public:
  /// Reads the value; words that say why it cannot.
  using Load = std::function<std::variant<T, std::string>()>;

  Reloaded(std::vector<std::filesystem::path> files, Load load)
      : files_(std::move(files)), load_(std::move(load)) {}

  /// Reads the value if the files are not those of the last look. Returns the mistake if that
  /// fails; empty otherwise.
  std::string Look() {
    const Stamps now = Stamp();
    if (now == seen_) return "";
    seen_ = now;
    auto loaded = load_();
    if (const auto* mistake = std::get_if<std::string>(&loaded)) {
      ++failures_;
      return *mistake;
    }
    const MutexLock lock(mutex_);
    value_ = std::make_shared<const T>(std::get<T>(std::move(loaded)));
    return "";
  }

  /// The value; null before the first Look that succeeds.
  std::shared_ptr<const T> value() const {
    const MutexLock lock(mutex_);
    return value_;
  }
  /// Number of changes that could not be used.
  std::int64_t failures() const { return failures_; }

 private:
  /// Of each file: device, inode, size, mode, and the times of its last changes.
  using Stamps = std::vector<std::array<std::int64_t, 8>>;
  Stamps Stamp() const {
    Stamps stamps;
    for (const auto& file : files_) {
      struct stat s = {};
      if (::stat(file.c_str(), &s) != 0) s = {};
      stamps.push_back({static_cast<std::int64_t>(s.st_dev), static_cast<std::int64_t>(s.st_ino),
                        s.st_size, static_cast<std::int64_t>(s.st_mode), s.st_mtim.tv_sec,
                        s.st_mtim.tv_nsec, s.st_ctim.tv_sec, s.st_ctim.tv_nsec});
    }
    return stamps;
  }

  const std::vector<std::filesystem::path> files_;
  const Load load_;
  /// Empty before the first look.
  Stamps seen_;
  std::atomic<std::int64_t> failures_ = 0;
  mutable Mutex mutex_;
  std::shared_ptr<const T> value_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
