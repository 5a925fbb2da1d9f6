#pragma once

#include <string>
#include <string_view>

namespace contact {

/// The bytes as hexadecimal digits, in lower case.
std::string Hex(std::string_view bytes);

/// SHA-256 of the bytes, 64 hexadecimal digits in lower case.
std::string Sha256Hex(std::string_view bytes);

/// HMAC-SHA-256 of the bytes with this key, 64 hexadecimal digits in lower case.
std::string HmacHex(const std::string& key, std::string_view bytes);

}  // namespace contact
