#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "gateway/protocol/origin.h"
#include "rpc/net/connection_acceptor.h"

namespace contact {

/// Settings of the gateway.
struct GatewayOptions {
  gateway::OriginRules rules = {};
  /// Files of the dashboard; empty: none.
  std::filesystem::path web_dir = {};
  /// Largest body of a request [B].
  std::size_t max_body_bytes = 2 << 20;
  /// Memory of the bodies of all requests, and as much of all whole answers that are not yet sent
  /// [B]; those up to 64 KiB are not counted.
  std::size_t memory = 64 << 20;
  ConnectionLimits connections = {.in_all = 1024, .per_peer = 1024};
  /// A client that takes nothing for this time is dropped.
  std::chrono::milliseconds stall{30'000};
  /// Times that a client has, however it spends them: between two requests, for a head, for a body,
  /// to take a whole answer.
  std::chrono::milliseconds idle{60'000};
  std::chrono::milliseconds head{10'000};
  std::chrono::milliseconds body{30'000};
  std::chrono::milliseconds answer{120'000};
  /// The text of `/metrics`. Empty: it is not served.
  std::function<std::string()> metrics = {};
};

}  // namespace contact
