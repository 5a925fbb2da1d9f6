#pragma once

#include <boost/beast/http.hpp>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// What Beast has parsed, without the body. The one header with Beast in it: for those who parse.
HttpRequest HeadOf(const boost::beast::http::request<boost::beast::http::string_body>& message);

}  // namespace contact::gateway
