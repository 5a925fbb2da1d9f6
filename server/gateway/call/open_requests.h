#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>

#include "base/mutex.h"

namespace contact::gateway {

/// Requests that are being answered. Their answers ask the gRPC server, which therefore ends after
/// them. Thread-safe.
class OpenRequests {
 public:
  struct End {
    void operator()(OpenRequests* requests) const { requests->Ended(); }
  };
  /// A request that is being answered, until this goes.
  using Request = std::unique_ptr<OpenRequests, End>;

  /// Null once Finish was called: the request is not to be answered any more.
  Request Begin();

  /// Lets no further request begin. Waits until those that have begun are answered, for at most
  /// `grace`.
  void Finish(std::chrono::milliseconds grace);

 private:
  void Ended();

  Mutex mutex_;
  std::condition_variable_any ended_;
  int open_ ABSL_GUARDED_BY(mutex_) = 0;
  bool finishing_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace contact::gateway
