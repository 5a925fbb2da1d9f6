#pragma once

#include <cstdint>
#include <functional>

namespace contact {

/// Says when the process takes more memory than all workers may have together. Not thread-safe.
class MemoryWatch {
 public:
  /// `resident`: what the process takes now [B]. `most` [B]; 0: any number.
  MemoryWatch(std::function<std::int64_t()> resident, std::int64_t most);

  /// Looks, and tells the log of a change. Returns crowded().
  bool Look();
  /// True if there was too little memory when it looked last. Nine tenths of the most have to
  /// suffice again before that ends, or it would come and go.
  bool crowded() const { return crowded_; }

 private:
  const std::function<std::int64_t()> resident_;
  const std::int64_t most_;
  bool crowded_ = false;
};

}  // namespace contact
