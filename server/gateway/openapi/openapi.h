#pragma once

#include <string_view>

namespace contact::gateway {

/// What the gateway can be asked, as an OpenAPI 3.1 document in JSON. openapi.py makes it of the
/// contract when contactd is built.
std::string_view OpenApiDocument();

}  // namespace contact::gateway
