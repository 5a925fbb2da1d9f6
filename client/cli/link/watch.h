#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"
#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Receives what a watch brings, on the thread that called Watch.
class WatchObserver {
 public:
  virtual ~WatchObserver() = default;
  virtual void OnSnapshot(const v1::Job&) {}  ///< At every connection.
  virtual void OnEvent(const v1::Event&) {}   ///< Each event once, in order.
  /// The connection was lost; another try follows.
  virtual void OnLost(const std::string& /*why*/, std::chrono::milliseconds /*pause*/) {}
  virtual void OnTick() {}  ///< About ten times a second.
};

/// Which events Watch asks for, and for how long.
struct WatchOptions {
  std::string name;                  ///< `jobs/ID`.
  std::uint64_t after_sequence = 0;  ///< Only events after this one.
  std::vector<std::string> kinds;    ///< Empty: all.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<bool()> stopped = [] { return false; };  ///< Asked about ten times a second.

  /// What the server does with frame chunks for which this client is too slow.
  v1::DeliveryOptions::OverflowPolicy overflow = v1::DeliveryOptions::CONFLATE;
  std::chrono::milliseconds min_frame_interval{0};  ///< 0: no frame chunk is left out.
  bool live_only = false;  ///< Begin after the newest event; only with `after_sequence` 0.
  Patience patience = {};  ///< With a server that cannot be reached.
};

/// Follows the log of a job to its end, across connections: no event is missed or heard twice.
/// Throws CallFailure if the server refuses to be asked again, if it could never be reached, or
/// not for too long.
WatchEnd Watch(Client& client, const WatchOptions& options, WatchObserver& observer);

/// True for SUCCEEDED, FAILED and CANCELLED.
bool IsFinal(v1::Job::State state);

}  // namespace contact::cli
