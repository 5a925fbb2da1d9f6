#pragma once

namespace contact {

/// Sends what gRPC logs to spdlog, at most 10 lines a second from each place in its source: bad
/// peers must not fill the disk. Call it once, before gRPC is used.
void RouteGrpcLog();

}  // namespace contact
