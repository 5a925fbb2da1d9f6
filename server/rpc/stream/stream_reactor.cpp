#include "rpc/stream/stream_reactor.h"

namespace contact {

grpc::Status StreamDraining() {
  return ToGrpc({.code = absl::StatusCode::kUnavailable,
                 .reason = "SERVER_DRAINING",
                 .message = "the server is shutting down; ask again",
                 .retry_after = std::chrono::seconds{1}});
}

grpc::Status StreamUnreadable(const std::string& what) {
  return ToGrpc({.code = absl::StatusCode::kUnavailable,
                 .reason = "STORE_FAILED",
                 .message = what + " could not be read from the store; watch again",
                 .retry_after = std::chrono::seconds{1}});
}

}  // namespace contact
