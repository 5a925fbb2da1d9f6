#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "gateway/net/tls_context.h"
#include "gateway/protocol/origin.h"
#include "rpc/net/connection_limits.h"

namespace contact {

/// Settings of a listener of the gateway.
struct GatewayOptions {
  gateway::OriginRules rules = {};
  /// How connections are protected; null: not at all.
  std::shared_ptr<const gateway::TlsContext> tls = {};
  /// True: what clients say in `x-contactd-principal` is passed on; they are one trusted proxy.
  bool trusts_principal = false;
  /// Files of the dashboard; empty: none.
  std::filesystem::path web_dir = {};
  /// Files of the documentation, at `/docs`; empty: none.
  std::filesystem::path docs_dir = {};
  /// Largest body or message of a request [B].
  std::size_t max_body_bytes = 2 << 20;
  /// Memory of the bodies of all requests, and as much of all whole answers that are not yet sent
  /// [B]; those up to 64 KiB are not counted.
  std::size_t memory = 64 << 20;
  ConnectionLimits connections = {};
  /// A client that takes nothing for this time is dropped.
  std::chrono::milliseconds stall{30'000};
  /// Times that a client has, however it spends them: for TLS and its first byte, between two
  /// requests of HTTP/1.1, for a head, for a body, to take a whole answer.
  std::chrono::milliseconds handshake{5'000};
  std::chrono::milliseconds idle{60'000};
  std::chrono::milliseconds head{10'000};
  std::chrono::milliseconds body{30'000};
  std::chrono::milliseconds answer{120'000};
  /// The text of `/metrics`. Empty: it is not served.
  std::function<std::string()> metrics = {};
};

}  // namespace contact
