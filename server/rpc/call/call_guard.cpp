#include "rpc/call/call_guard.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace contact {
namespace {

using std::chrono::steady_clock;
using std::chrono::system_clock;

constexpr std::chrono::seconds kDefaultDeadline{30};
// As HTTP/2 counts a header.
constexpr std::size_t kEntryBytes = 32;

std::size_t MetadataBytes(const grpc::ServerContextBase& context) {
  std::size_t bytes = 0;
  for (const auto& [name, value] : context.client_metadata()) {
    bytes += name.size() + value.size() + kEntryBytes;
  }
  return bytes;
}

}  // namespace

CallGuard::CallGuard(CallLimits limits, std::shared_ptr<const PeerCounts> streams,
                     std::shared_ptr<RpcMetrics> metrics)
    : limits_(limits),
      streams_(std::move(streams)),
      metrics_(std::move(metrics)),
      creates_(limits.max_creates_per_second, limits.max_create_burst) {}

std::optional<Error> CallGuard::Check(const grpc::ServerContextBase& context) const {
  const std::size_t bytes = MetadataBytes(context);
  if (bytes <= static_cast<std::size_t>(limits_.max_metadata_bytes)) return std::nullopt;
  return Refuse(
      "METADATA_TOO_LARGE",
      fmt::format("{} bytes of metadata; at most {} are taken", bytes, limits_.max_metadata_bytes),
      std::chrono::milliseconds(0));
}

std::optional<Error> CallGuard::CheckCreate(const grpc::CallbackServerContext& context) {
  const auto wait = creates_.Take(PeerOf(context.peer()), steady_clock::now());
  if (wait.count() == 0) return std::nullopt;
  return Refuse("RATE_LIMITED",
                fmt::format("more than {:g} CreateJob calls a second from this address",
                            limits_.max_creates_per_second),
                wait);
}

std::optional<Error> CallGuard::CheckStream(const grpc::CallbackServerContext& context) const {
  if (auto refusal = Check(context)) return refusal;
  if (streams_->Of(PeerOf(context.peer())) <= limits_.max_watchers_per_peer) return std::nullopt;
  return Refuse(
      "WATCHER_LIMIT",
      fmt::format("there are {} watchers from this address already", limits_.max_watchers_per_peer),
      std::chrono::seconds(1));
}

Error CallGuard::Refuse(const char* reason, std::string message,
                        std::chrono::milliseconds retry_after) const {
  metrics_->Refused(reason);
  return {.code = absl::StatusCode::kResourceExhausted,
          .reason = reason,
          .message = std::move(message),
          .retry_after = retry_after};
}

std::function<bool()> Abandonment(const grpc::CallbackServerContext& context) {
  const bool unlimited = context.deadline() == system_clock::time_point::max();
  const auto deadline = unlimited ? system_clock::now() + kDefaultDeadline : context.deadline();
  return [&context, deadline] { return context.IsCancelled() || system_clock::now() > deadline; };
}

}  // namespace contact
