#pragma once

#include <memory>

#include "gateway/call/exchange.h"
#include "gateway/call/service.h"

namespace contact::gateway {

/// Answers a request, by the gRPC server or with a file. False: the connection is to end. Service
/// and exchange live as long as the coroutine.
Awaitable<bool> Answer(Service& service, std::shared_ptr<Exchange> exchange,
                       const HttpRequest& request);

}  // namespace contact::gateway
