#include "gateway/http2/headers.h"

#include <cstdint>
#include <string>

namespace contact::gateway {

std::vector<nghttp2_nv> ToNv(const Headers& headers) {
  std::vector<nghttp2_nv> all;
  for (const auto& [name, value] : headers) {
    const auto bytes = [](const std::string& text) {
      return const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(text.data()));
    };
    if (!IsFieldValue(value)) continue;
    all.push_back({bytes(name), bytes(value), name.size(), value.size(), NGHTTP2_NV_FLAG_NONE});
  }
  return all;
}

}  // namespace contact::gateway
