#pragma once

#include <cstdint>
#include <string>

namespace contact {

/// CRC-32 (zlib's) of bytes and of the place where they belong, such as a sequence: bytes that
/// were changed or that moved fail it.
std::int64_t Checksum(const std::string& bytes, std::uint64_t place = 0);

}  // namespace contact
