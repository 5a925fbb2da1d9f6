#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <optional>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"

namespace contact::cli {

/// One watch over all its connections: opens a stream again whenever it is lost. `Options` has
/// `deadline`, `stopped` and `patience`; `Observer` has OnLost, OnRegained and OnTick. Not
/// thread-safe.
template <class Options, class Observer>
class StreamWatch {
 public:
  /// All three must outlive this object.
  StreamWatch(Client& client, const Options& options, Observer& observer)
      : client_(client),
        options_(options),
        observer_(observer),
        reconnection_(client.server(), options.patience) {}
  virtual ~StreamWatch() = default;

  /// Connects until the watch ends. Throws CallFailure as Reconnection::Lost does.
  WatchEnd Follow() {
    while (true) {
      const grpc::Status status = Connect();
      if (end_) return *end_;
      const bool told = reconnection_.lost();
      const std::chrono::milliseconds pause = reconnection_.Lost(status);
      if (!told) observer_.OnLost(WhyLost(status));
      Rest(*client_.channel(), pause, [this] { return GoOn(); });
      if (end_) return *end_;
    }
  }

 protected:
  /// Reads one stream until it ends or GoOn returns false. Returns how the stream ended. Sets end_
  /// if the end of the stream is that of the watch.
  virtual grpc::Status Connect() = 0;

  /// To be called about ten times a second. Returns false, with end_ set, when the watch ends; else
  /// tells the observer the time.
  bool GoOn() {
    if (end_) return false;
    if (options_.stopped()) {
      end_ = WatchEnd::kStopped;
    } else if (options_.deadline && std::chrono::steady_clock::now() >= *options_.deadline) {
      end_ = WatchEnd::kTimedOut;
    } else {
      observer_.OnTick();
    }
    return !end_;
  }

  /// To be called by Connect for each message.
  void Heard() {
    if (reconnection_.Heard()) observer_.OnRegained();
  }

  Client& client_;
  const Options& options_;
  Observer& observer_;
  /// Set as soon as the watch ends.
  std::optional<WatchEnd> end_;

 private:
  Reconnection reconnection_;
};

}  // namespace contact::cli
