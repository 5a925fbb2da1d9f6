#pragma once

#include <boost/asio/io_context.hpp>
#include <memory>

#include "gateway/service.h"

namespace contact::gateway {

/// Serves the connection `fd` until it ends, on the one thread of `io`. Takes the descriptor over;
/// the service lives as long as `io` runs.
void Serve(boost::asio::io_context& io, Service& service, int fd);

}  // namespace contact::gateway
