#include "rpc/call/call_guard.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>
#include <variant>
#include <vector>

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
    if (!name.starts_with("x-contactd-")) bytes += name.size() + value.size() + kEntryBytes;
  }
  return bytes;
}

// All values of a name in the metadata of the call.
std::vector<std::string> ValuesOf(const char* name, const grpc::ServerContextBase& context) {
  std::vector<std::string> values;
  const auto [begin, end] = context.client_metadata().equal_range(name);
  for (auto entry = begin; entry != end; ++entry) {
    values.emplace_back(entry->second.data(), entry->second.size());
  }
  return values;
}

// What the caller shows of itself, and what the gateway says of its connection.
Presented PresentedBy(const grpc::ServerContextBase& context) {
  return {.authorization = ValuesOf("authorization", context),
          .certificate = ValuesOf(kCertificateHeader, context),
          .principal = ValuesOf(kPrincipalHeader, context)};
}

}  // namespace

CallGuard::CallGuard(CallLimits limits, Door door, Quotas& quotas,
                     std::shared_ptr<const PeerCounts> streams, std::shared_ptr<RpcMetrics> metrics,
                     const Clock& clock)
    : limits_(limits),
      door_(std::move(door)),
      quotas_(quotas),
      clock_(clock),
      streams_(std::move(streams)),
      metrics_(std::move(metrics)),
      creates_(limits.max_creates_per_second, limits.max_create_burst) {}

Admission CallGuard::Check(const grpc::ServerContextBase& context, std::string_view method,
                           CallKind kind) {
  if (auto refusal = CheckMetadata(context)) return {{}, refusal};
  const auto known =
      door_.Identify(door_.asks() ? PresentedBy(context) : Presented{}, clock_.Now());
  if (const auto* why = std::get_if<std::string>(&known)) {
    return {{}, Refuse(Reason::kUnauthenticated, *why)};
  }
  const auto& caller = std::get<Principal>(known);
  if (const MethodRule* rule = FindMethod(method); !rule || !May(caller, rule->needs)) {
    return {caller, Deny(caller, rule)};
  }
  if (!IsKnownAdmin(caller)) {
    if (auto refusal = CheckPeer(context, kind)) return {caller, refusal};
  }
  Result<Quotas::Place> held = CheckQuotas(context, caller, kind);
  if (held.ok()) return {caller, {}, std::move(held.value())};
  NoteRefusal(held.error());
  return {caller, held.error()};
}

std::function<std::optional<Error>()> CallGuard::RightOf(const grpc::ServerContextBase& context,
                                                         std::string_view method,
                                                         const Principal& caller) const {
  if (!door_.asks()) return {};
  return [this, presented = PresentedBy(context), rule = FindMethod(method),
          caller]() -> std::optional<Error> {
    const auto known = door_.Identify(presented, clock_.Now());
    if (const auto* why = std::get_if<std::string>(&known)) {
      return Refuse(Reason::kUnauthenticated, *why);
    }
    const auto& now = std::get<Principal>(known);
    if (!May(now, rule->needs)) return Deny(now, rule);
    if (now == caller) return std::nullopt;
    return Refuse(Reason::kUnauthenticated, "the caller is another principal now; call again");
  };
}

void CallGuard::NoteRefusal(const Error& error) const {
  if (error.reason != InfoOf(Reason::kQuotaExceeded).name) return;
  metrics_->Refused(error.reason, error.metadata.at("resource"));
}

Result<Quotas::Place> CallGuard::CheckQuotas(const grpc::ServerContextBase& context,
                                             const Principal& caller, CallKind kind) {
  const JobOwner whose{caller.name, caller.tenant};
  if (kind == CallKind::kCreateJob) {
    if (auto refusal = quotas_.TakeCreateCall(whose)) return *refusal;
  }
  Result<Quotas::Place> connection = quotas_.TakeConnection(whose, CallerUri(context));
  if (!connection.ok()) return connection;
  Result<Quotas::Place> call =
      quotas_.Take(whose, kind == CallKind::kStream ? v1::Quota::STREAMS : v1::Quota::CALLS);
  if (!call.ok()) return call;
  return Quotas::Both(std::move(connection.value()), std::move(call.value()));
}

Error CallGuard::Deny(const Principal& caller, const MethodRule* rule) const {
  const std::string needed = rule ? NameOf(rule->needs) : "none";
  metrics_->Refused(InfoOf(Reason::kPermissionDenied).name);
  return Denied(needed,
                fmt::format("{} may not do that; it needs the role {}", caller.name, needed));
}

std::optional<Error> CallGuard::CheckPeer(const grpc::ServerContextBase& context, CallKind kind) {
  if (kind == CallKind::kUnary) return std::nullopt;
  const std::string peer = PeerOf(CallerUri(context));
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
