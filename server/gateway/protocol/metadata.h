#pragma once

#include <grpcpp/support/string_ref.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// Metadata as a gRPC client gives it; those of names that end in `-bin` are bytes.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The headers of a request that are metadata of the call: all but those of HTTP, of browsers and
/// of the protocols, and but those that only the gateway or a trusted proxy may say
/// (`x-contactd-…`). Nothing if a name or value may not be metadata; `mistake` then says why.
std::optional<Metadata> ToMetadata(const Headers& headers, std::string* mistake);

/// The metadata of an answer as headers whose names begin with `prefix`, without gRPC's own.
Headers ToHeaders(const std::multimap<grpc::string_ref, grpc::string_ref>& metadata,
                  std::string_view prefix);

/// A deadline that is `connect-timeout-ms`, in ms: up to 10 digits. Nothing if it is none.
std::optional<std::int64_t> ConnectTimeout(std::string_view text);

/// A deadline that is `grpc-timeout`, in ms, rounded up: up to 8 digits and a unit. Nothing if it
/// is none.
std::optional<std::int64_t> GrpcTimeout(std::string_view text);

}  // namespace contact::gateway
