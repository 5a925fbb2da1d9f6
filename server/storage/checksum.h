#pragma once

#include <cstdint>
#include <string>

#include "storage/event_coding.h"

namespace contact {

/// CRC-32 (zlib's) of bytes and of the place where they belong, such as a sequence: bytes that
/// were changed or that moved fail it.
std::int64_t Checksum(const std::string& bytes, std::uint64_t place = 0);

/// The same of an event, which belongs to its sequence and is read by its coding.
std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence);

}  // namespace contact
