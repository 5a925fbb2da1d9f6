#pragma once

namespace contact {

/// Sends what gRPC logs to spdlog, at most 10 lines a second from each place in gRPC's source, so
/// that bad peers cannot fill the disk. To be called once, before gRPC is used.
void RouteGrpcLog();

}  // namespace contact
