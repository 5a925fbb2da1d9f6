#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <optional>
#include <random>
#include <string>

#include "cli/link/client.h"

namespace contact::cli {

/// How often a stream is looked at while it brings nothing.
inline constexpr std::chrono::milliseconds kStreamTick{100};

/// Why a watch ended.
enum class WatchEnd {
  kFinished,  ///< The job ended, and all its events came.
  kStopped,   ///< `stopped` returned true.
  kTimedOut,  ///< The deadline passed.
};

/// When to ask again after a stream has ended early, and when to give up.
struct Patience {
  /// Before the first new attempt. The pause doubles with each, and has jitter.
  std::chrono::milliseconds first_pause{200};
  /// The pause does not grow beyond this one.
  std::chrono::milliseconds longest_pause{10'000};
  /// How long there may be no message before Lost throws.
  std::chrono::milliseconds give_up_after{300'000};
};

/// Decides when a stream is opened again, over all its connections.
class Reconnection {
 public:
  /// `server` is HOST:PORT, for messages.
  Reconnection(std::string server, const Patience& patience)
      : server_(std::move(server)), patience_(patience), pause_(patience.first_pause) {}

  /// To be called for each message: pauses start from the shortest again. Returns whether the
  /// stream was lost since the message before.
  bool Heard();

  /// True from a call of Lost to the next message.
  bool lost() const { return lost_since_.has_value(); }

  /// To be called when the stream has ended too early, with its status. Returns how long to wait
  /// before the next attempt. Throws CallFailure if another attempt is hopeless: the answer would
  /// be the same, the server was never reached, or not for `give_up_after`.
  std::chrono::milliseconds Lost(const grpc::Status& status);

 private:
  const std::string server_;
  const Patience patience_;
  /// Upper end of the next pause.
  std::chrono::milliseconds pause_;
  /// When the stream was first lost since the last message; none while it is not.
  std::optional<std::chrono::steady_clock::time_point> lost_since_;
  /// True once a message has come on any connection.
  bool connected_ = false;
  std::mt19937 random_{std::random_device{}()};
};

/// Waits for `pause`, or until `go_on` returns false; it is called about ten times a second. The
/// channel connects meanwhile: without anybody who waits, gRPC looks at it every 5 s only.
void Rest(grpc::Channel& channel, std::chrono::milliseconds pause,
          const std::function<bool()>& go_on);

/// Why a stream with this status was lost, in few words.
std::string WhyLost(const grpc::Status& status);

}  // namespace contact::cli
