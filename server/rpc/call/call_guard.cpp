#include "rpc/call/call_guard.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "base/spelling.h"

namespace contact {
namespace {

using std::chrono::system_clock;

// Deadline of a call that has none.
constexpr std::chrono::seconds kDefaultDeadline{30};
// Size that HTTP/2 adds to each header (RFC 9113, 6.5.2).
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
                     std::shared_ptr<RpcMetrics> metrics, const Clock& clock)
    : limits_(limits),
      clock_(clock),
      streams_(std::move(streams)),
      metrics_(std::move(metrics)),
      creates_(limits.max_creates_per_second, limits.max_create_burst) {}

std::optional<Error> CallGuard::Check(const grpc::ServerContextBase& context, CallKind kind) {
  if (auto refusal = CheckMetadata(context)) return refusal;
  if (kind == CallKind::kUnary) return std::nullopt;
  const std::string peer = PeerOf(context.peer());
  return kind == CallKind::kStream ? CheckStreams(peer) : CheckRate(peer);
}

std::optional<Error> CallGuard::CheckMetadata(const grpc::ServerContextBase& context) const {
  const std::size_t bytes = MetadataBytes(context);
  if (bytes <= static_cast<std::size_t>(limits_.max_metadata_bytes)) return std::nullopt;
  return Refuse(Reason::kMetadataTooLarge, fmt::format("{} bytes of metadata; at most {} are taken",
                                                       bytes, limits_.max_metadata_bytes));
}

std::optional<Error> CallGuard::CheckRate(const std::string& peer) {
  const auto wait = creates_.Take(peer, clock_.Elapsed());
  if (wait.count() == 0) return std::nullopt;
  Error error = Refuse(Reason::kRateLimited,
                       fmt::format("more than {:g} CreateJob calls a second from this address",
                                   limits_.max_creates_per_second));
  error.retry_after = wait;
  return error;
}

std::optional<Error> CallGuard::CheckStreams(const std::string& peer) const {
  if (streams_->Of(peer) <= limits_.max_watchers_per_peer) return std::nullopt;
  return Refuse(Reason::kWatcherLimit,
                Count(limits_.max_watchers_per_peer, "watcher is", "watchers are") +
                    " there from this address already");
}

Error CallGuard::Refuse(Reason reason, std::string message) const {
  Error error = MakeError(reason, std::move(message));
  metrics_->Refused(error.reason);
  return error;
}

std::function<bool()> Abandonment(const grpc::CallbackServerContext& context) {
  const bool unlimited = context.deadline() == system_clock::time_point::max();
  const auto deadline = unlimited ? system_clock::now() + kDefaultDeadline : context.deadline();
  return [&context, deadline] { return context.IsCancelled() || system_clock::now() > deadline; };
}

}  // namespace contact
