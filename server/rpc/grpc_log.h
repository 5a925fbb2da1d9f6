#pragma once

namespace contact {

/// Sends what gRPC and protobuf log to spdlog, at most 10 lines a second from each place in their
/// sources, so that bad peers cannot fill the disk. To be called once, before gRPC is used.
void RouteGrpcLog();

}  // namespace contact
