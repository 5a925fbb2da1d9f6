#include "identity/hex.h"

#include "base/digest.h"

namespace contact {

std::string Hex(std::string_view bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    hex += kDigits[byte >> 4U];
    hex += kDigits[byte & 15U];
  }
  return hex;
}

std::string Sha256Hex(std::string_view bytes) {
  Sha256 digest;
  digest.Add(bytes);
  return Hex(digest.Finish());
}

std::string HmacHex(const std::string& key, std::string_view bytes) {
  return Hex(HmacSha256(key, bytes));
}

}  // namespace contact
