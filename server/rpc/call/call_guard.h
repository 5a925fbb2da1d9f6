#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/clock.h"
#include "identity/door.h"
#include "identity/permissions.h"
#include "jobs/job/errors.h"
#include "jobs/quota/quotas.h"
#include "jobs/quota/rate_limit.h"
#include "rpc/metrics/rpc_metrics.h"
#include "rpc/net/peer.h"

namespace contact {

/// Limits of calls. A peer is one address of the network.
struct CallLimits {
  /// Bytes of metadata of a call: names, values, and 32 for each entry.
  int max_metadata_bytes = 8192;
  /// CreateJob calls of a peer, on average. 0: any number.
  double max_creates_per_second = 1000;
  /// CreateJob calls of a peer at once, after a rest.
  int max_create_burst = 10'000;
  /// Streams that a peer may have open.
  int max_watchers_per_peer = 10'000;
};

/// What the limits tell apart.
enum class CallKind {
  /// A unary call other than CreateJob.
  kUnary,
  /// A CreateJob call.
  kCreateJob,
  /// A call that streams.
  kStream,
};

/// Who calls, once that has been found out; and why the call is refused, if it is.
struct Admission {
  /// Nothing if the caller is not known.
  std::optional<Principal> caller = {};
  std::optional<Error> refusal = {};
  /// What the call takes of the caller's limits while it is open.
  Quotas::Place held = {};
};

/// Refuses calls before anything is done for them: the one place that asks who calls and what that
/// one may do. Thread-safe.
class CallGuard {
 public:
  /// `streams` counts the streams that are open, including the one in question. `quotas` and
  /// `clock` outlive the guard.
  CallGuard(CallLimits limits, Door door, Quotas& quotas, std::shared_ptr<const PeerCounts> streams,
            std::shared_ptr<RpcMetrics> metrics, const Clock& clock);

  /// Says who makes the call, and whether it is refused before its request is looked at. In this
  /// order: METADATA_TOO_LARGE, UNAUTHENTICATED, PERMISSION_DENIED by the table of methods,
  /// RATE_LIMITED for kCreateJob, WATCHER_LIMIT for kStream, QUOTA_EXCEEDED. Takes a CreateJob's
  /// token from the buckets of its peer and its caller. The limits of a peer do not hold for known
  /// admins: others at the same address must not keep them out. Counts refusals.
  Admission Check(const grpc::ServerContextBase& context, std::string_view method, CallKind kind);
  /// Says of a caller that has come in whether it may go on: whether what it has shown still makes
  /// it the same principal. Empty where everybody comes in. The guard outlives the function.
  std::function<std::optional<Error>()> RightOf(const grpc::ServerContextBase& context,
                                                std::string_view method,
                                                const Principal& caller) const;
  /// Counts a call that was refused later, if that was for a quota.
  void NoteRefusal(const Error& error) const;

 private:
  /// The errors of the limits of a peer.
  std::optional<Error> CheckPeer(const grpc::ServerContextBase& context, CallKind kind);
  /// Takes what the call needs of the caller's limits.
  Result<Quotas::Place> CheckQuotas(const grpc::ServerContextBase& context, const Principal& caller,
                                    CallKind kind);
  /// Counts what a client has sent, and not what the gateway adds.
  std::optional<Error> CheckMetadata(const grpc::ServerContextBase& context) const;
  /// Takes a token from the bucket of the peer.
  std::optional<Error> CheckRate(const std::string& peer);
  /// Counts the streams of the peer.
  std::optional<Error> CheckStreams(const std::string& peer) const;
  /// The error of a caller that the row, or its absence, forbids.
  Error Deny(const Principal& caller, const MethodRule* rule) const;
  /// An error of this reason, which is counted.
  Error Refuse(Reason reason, std::string message) const;

  const CallLimits limits_;
  const Door door_;
  Quotas& quotas_;
  const Clock& clock_;
  /// Open streams of each peer.
  const std::shared_ptr<const PeerCounts> streams_;
  const std::shared_ptr<RpcMetrics> metrics_;
  /// Buckets of CreateJob calls.
  RateLimit creates_;
};

/// A function that is true once nobody waits for the answer any more: the caller has left or its
/// deadline has passed. A call without deadline has one of 30 s. The function may be called until
/// the call is finished.
std::function<bool()> Abandonment(const grpc::CallbackServerContext& context);

}  // namespace contact
