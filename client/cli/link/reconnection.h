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

/// When to ask again after a stream has ended early, and when to give up.
struct Patience {
  std::chrono::milliseconds first_pause{200};  ///< Before trying again; doubles, with jitter.
  std::chrono::milliseconds longest_pause{10'000};
  std::chrono::milliseconds give_up_after{300'000};  ///< Without any connection.
};

/// Keeps to a Patience, for one stream over all its connections.
class Reconnection {
 public:
  Reconnection(std::string server, const Patience& patience)
      : server_(std::move(server)), patience_(patience), pause_(patience.first_pause) {}

  /// A message came.
  void Heard();

  /// The stream ended so, and not as it should. Returns how long to wait; throws CallFailure if
  /// another try is hopeless: the answer would be the same, the server could never be reached, or
  /// not for too long.
  std::chrono::milliseconds Lost(const grpc::Status& status);

 private:
  const std::string server_;
  const Patience patience_;
  std::chrono::milliseconds pause_;
  std::optional<std::chrono::steady_clock::time_point> lost_since_;
  bool connected_ = false;  ///< Ever.
  std::mt19937 random_{std::random_device{}()};
};

/// Waits, but no longer than `go_on`, which is asked about ten times a second, says.
void Rest(std::chrono::milliseconds pause, const std::function<bool()>& go_on);

/// What to tell of a stream that ended so.
std::string WhyLost(const grpc::Status& status);

}  // namespace contact::cli
