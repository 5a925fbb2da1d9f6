#pragma once

#include <nghttp2/nghttp2.h>

#include <vector>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// Headers as nghttp2 takes them, without those that cannot be sent. Valid while `headers` is.
std::vector<nghttp2_nv> ToNv(const Headers& headers);

}  // namespace contact::gateway
