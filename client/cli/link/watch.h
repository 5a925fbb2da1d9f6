#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"
#include "cli/settings/settings.h"
#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Receives what a watch brings, on the thread that called Watch.
class WatchObserver {
 public:
  virtual ~WatchObserver() = default;
  /// The job as it is when a connection begins, at every connection.
  virtual void OnSnapshot(const v1::Job&) {}
  /// Each event once, in order.
  virtual void OnEvent(const v1::Event&) {}
  /// The connection was lost; other tries follow. Called once, however many they are.
  virtual void OnLost(const std::string& /*why*/) {}
  /// The connection is there again after OnLost.
  virtual void OnRegained() {}
  /// Called about ten times a second.
  virtual void OnTick() {}
};

/// Which events Watch asks for, and for how long.
struct WatchOptions {
  /// `jobs/ID`.
  std::string name;
  /// Only events with a higher sequence number come.
  std::uint64_t after_sequence = 0;
  /// Only events of these kinds come, such as `cycle`; empty: all.
  std::vector<std::string> kinds = {};
  /// When to stop; never, if unset.
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  /// Asked about ten times a second; true ends the watch.
  std::function<bool()> stopped = [] { return false; };

  /// What the server does with frame chunks for which this client is too slow.
  v1::DeliveryOptions::OverflowPolicy overflow = v1::DeliveryOptions::CONFLATE;
  /// The server leaves out frame chunks that follow sooner; 0: none.
  std::chrono::milliseconds min_frame_interval{0};
  /// Begin after the newest event; only with `after_sequence` 0.
  bool live_only = false;
  /// With a server that cannot be reached.
  Patience patience = {};
};

/// Follows the log of a job to its end, across connections: no event is missed or heard twice.
/// Throws CallFailure if the server refuses to be asked again, if it could never be reached, or
/// not for too long.
WatchEnd Watch(Client& client, const WatchOptions& options, WatchObserver& observer);

/// True for SUCCEEDED, FAILED and CANCELLED.
bool IsFinal(v1::Job::State state);

/// Says on the standard error that the connection was lost and other attempts follow.
void TellLost(const std::string& why);
/// Says that the connection is there again.
void TellRegained();

/// Watches a job until it has ended and all its events were heard. While a job that has not ended
/// is waited for, a message says so, as one does of a lost connection. The time limit of `settings`
/// and Ctrl-C, while the caller holds an Interrupt, end the watch early; `options.deadline` and
/// `options.stopped` are replaced by them. Throws CallFailure as Watch does, and Failure (kTimeout,
/// kInterrupted) if the watch ends before the job.
void WatchToEnd(Client& client, WatchOptions options, const Settings& settings,
                WatchObserver& observer);

/// Calls `replay` until it returns true for a recording without holes, at most twice. Throws
/// Failure (kRunFailed), which names `job`, if both recordings have holes.
void ReplayWhole(const std::string& job, const std::function<bool()>& replay);

}  // namespace contact::cli
