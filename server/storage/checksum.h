#pragma once

#include <cstdint>
#include <string>

#include "storage/event_coding.h"

namespace contact {

/// CRC-32 (zlib's) of bytes and of the place where they belong, such as a sequence: bytes that
/// were changed or that moved fail it. From 0 to 2^32 − 1.
std::int64_t Checksum(const std::string& bytes, std::uint64_t place = 0);

/// Checksum of an event with this sequence. Its coding counts as well, since that says how the
/// bytes are read.
std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence);

}  // namespace contact
