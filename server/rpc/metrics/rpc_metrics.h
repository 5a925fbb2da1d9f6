#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/histogram.h"
#include "base/mutex.h"

namespace contact {

/// Counters of a server's calls by method, which is a name such as
/// `/contact.v1.JobService/GetJob`. Thread-safe.
class RpcMetrics {
 public:
  /// A call has started.
  void Began(const std::string& method);
  /// A call has ended after `seconds` with `code`, a grpc::StatusCode.
  void Ended(const std::string& method, int code, double seconds);
  /// A stream has sent a message of `bytes` bytes.
  void Streamed(const std::string& method, std::int64_t bytes);
  /// A call was refused before anything was done for it. `reason` is that of its ErrorInfo; of a
  /// quota, `resource` is what there was too much of.
  void Refused(const std::string& reason, const std::string& resource = "");

  /// Counters of one method.
  struct Method {
    /// Calls that have not ended.
    std::int64_t open = 0;
    /// Calls that have ended, by code.
    std::map<int, std::int64_t> ended;
    /// Bytes of the messages that were sent.
    std::int64_t streamed_bytes = 0;
    /// Durations of ended calls.
    std::shared_ptr<Histogram> seconds = std::make_shared<Histogram>(DecadeBounds(-4, 2));
  };
  /// The methods that were called so far, by name.
  std::map<std::string, Method> methods() const;
  /// Numbers of refused calls, by reason.
  std::map<std::string, std::int64_t> refused() const;
  /// Those refused for a quota, by resource.
  std::map<std::string, std::int64_t> past_quota() const;

 private:
  mutable Mutex mutex_;
  /// By name.
  std::map<std::string, Method> methods_ ABSL_GUARDED_BY(mutex_);
  /// By reason.
  std::map<std::string, std::int64_t> refused_ ABSL_GUARDED_BY(mutex_);
  /// By resource.
  std::map<std::string, std::int64_t> past_quota_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
