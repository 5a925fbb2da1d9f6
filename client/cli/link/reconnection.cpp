#include "cli/link/reconnection.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace contact::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

// Ends of a stream after which the same question may be asked again. OK is one: the final event is
// missing, because of a proxy or a dying server.
constexpr grpc::StatusCode kMayPass[] = {
    grpc::OK,       grpc::UNAVAILABLE, grpc::CANCELLED,         grpc::UNKNOWN,
    grpc::INTERNAL, grpc::ABORTED,     grpc::DEADLINE_EXCEEDED, grpc::RESOURCE_EXHAUSTED};

bool Unreached(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::UNAVAILABLE && status.error_details().empty();
}

}  // namespace

bool Reconnection::Heard() {
  connected_ = true;
  pause_ = patience_.first_pause;
  return std::exchange(lost_since_, std::nullopt).has_value();
}

Milliseconds Reconnection::Lost(const grpc::Status& status) {
  const grpc::StatusCode code = status.error_code();
  const bool may_pass = std::ranges::find(kMayPass, code) != std::end(kMayPass);
  const bool hopeless = code == grpc::RESOURCE_EXHAUSTED || Unreached(status);
  if (!may_pass || (!connected_ && hopeless)) {
    throw CallFailure(status, server_);
  }
  if (!lost_since_) lost_since_ = Clock::now();
  if (Clock::now() - *lost_since_ > patience_.give_up_after) {
    throw CallFailure(
        status.ok() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "no answer") : status, server_);
  }
  // From half the pause to all of it, so that watchers of a restarted server do not come at once.
  std::uniform_real_distribution<double> jitter(0.5, 1.0);
  const auto pause = std::chrono::duration_cast<Milliseconds>(pause_ * jitter(random_));
  pause_ = std::min(2 * pause_, patience_.longest_pause);
  return pause;
}

void Rest(grpc::Channel& channel, Milliseconds pause, const std::function<bool()>& go_on) {
  const auto until = Clock::now() + pause;
  while (Clock::now() < until && go_on()) {
    const auto wait = std::min<Clock::duration>(kStreamTick, until - Clock::now());
    channel.WaitForStateChange(channel.GetState(true), std::chrono::system_clock::now() + wait);
  }
}

std::string WhyLost(const grpc::Status& status) {
  return status.ok() ? "the stream ended early" : TransportWords(status.error_message());
}

}  // namespace contact::cli
