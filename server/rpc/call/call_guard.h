#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "jobs/job/error.h"
#include "rpc/call/rate_limit.h"
#include "rpc/metrics/rpc_metrics.h"
#include "rpc/net/peer.h"

namespace contact {

/// What a server takes of calls. A peer is an address of the network.
struct CallLimits {
  int max_metadata_bytes = 8192;         ///< Names, values and 32 for each, in one call.
  double max_creates_per_second = 1000;  ///< CreateJob calls of a peer. 0: any number.
  int max_create_burst = 10'000;         ///< Of these, at once.
  int max_watchers_per_peer = 10'000;    ///< Streams that a peer has open.
};

/// Says no to calls before anything is done for them. Thread-safe.
class CallGuard {
 public:
  /// `streams` counts the streams that are open, including the one in question.
  CallGuard(CallLimits limits, std::shared_ptr<const PeerCounts> streams,
            std::shared_ptr<RpcMetrics> metrics);

  /// Why a call is refused whatever it asks for. gRPC has such a limit too, but a client that does
  /// not confirm the server's settings gets around it.
  std::optional<Error> Check(const grpc::ServerContextBase& context) const;

  /// Why this CreateJob is refused, beside that.
  std::optional<Error> CheckCreate(const grpc::CallbackServerContext& context);

  /// Why this stream is refused.
  std::optional<Error> CheckStream(const grpc::CallbackServerContext& context) const;

 private:
  Error Refuse(const char* reason, std::string message,
               std::chrono::milliseconds retry_after) const;

  const CallLimits limits_;
  const std::shared_ptr<const PeerCounts> streams_;
  const std::shared_ptr<RpcMetrics> metrics_;
  RateLimit creates_;
};

/// Tells whether nobody waits for the answer any more: the caller has left or its deadline has
/// passed. A call without deadline has 30 s. May be asked until the call is finished.
std::function<bool()> Abandonment(const grpc::CallbackServerContext& context);

}  // namespace contact
