#pragma once

#include <cstdint>
#include <string>

#include "storage/event_coding.h"

namespace contact {

/// CRC-32 (zlib's) of bytes and of the place where they belong, such as a sequence and the name of
/// a job: bytes that were changed or that moved fail it. From 0 to 2^32 − 1.
std::int64_t Checksum(const std::string& bytes, std::uint64_t place = 0,
                      const std::string& job = "");

/// Checksum of an event with this sequence. Its coding counts as well, since that says how the
/// bytes are read.
std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence, const std::string& job = "");

/// True if the bytes, or the event, have this checksum as what belongs to the job; or the one
/// without its name, as all had before version 7 of SQLite's tables and 5 of PostgreSQL's.
bool Passes(std::int64_t crc32, const std::string& bytes, const std::string& job);
bool Passes(std::int64_t crc32, const CodedEvent& event, std::uint64_t sequence,
            const std::string& job);

}  // namespace contact
