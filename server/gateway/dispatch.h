#pragma once

#include <memory>

#include "gateway/call/service.h"
#include "gateway/http2/connection.h"
#include "gateway/net/acceptor.h"
#include "gateway/net/held_bytes.h"

namespace contact::gateway {

/// Serves a connection until it ends, on the thread: makes the handshake of TLS if there is one,
/// and finds out by the first bytes which HTTP the client speaks.
void Dispatch(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
              Acceptor::Accepted connection);

}  // namespace contact::gateway
