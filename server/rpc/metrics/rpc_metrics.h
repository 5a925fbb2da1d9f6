#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/histogram.h"
#include "base/mutex.h"

namespace contact {

/// What the calls of a server have come to, by method, such as `/contact.v1.JobService/GetJob`.
/// Thread-safe.
class RpcMetrics {
 public:
  void Began(const std::string& method);
  /// `code` as in grpc::StatusCode.
  void Ended(const std::string& method, int code, double seconds);
  /// A stream has sent a message.
  void Streamed(const std::string& method, std::int64_t bytes);
  /// A call was refused before anything was done for it; reason as in ErrorInfo.
  void Refused(const std::string& reason);

  struct Method {
    std::int64_t open = 0;
    std::map<int, std::int64_t> ended;  ///< By code.
    std::int64_t streamed_bytes = 0;
    std::shared_ptr<Histogram> seconds = std::make_shared<Histogram>(DecadeBounds(-4, 2));
  };
  std::map<std::string, Method> methods() const;
  std::map<std::string, std::int64_t> refused() const;

 private:
  mutable Mutex mutex_;
  std::map<std::string, Method> methods_ ABSL_GUARDED_BY(mutex_);
  std::map<std::string, std::int64_t> refused_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
