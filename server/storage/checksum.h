#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

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

/// SQL expression on a row of jobs: the checksum of its columns that stand nowhere else, which
/// row_crc32 holds. Of the others state, owner, tenant and end_time repeat the header;
/// last_sequence and bytes follow from the log, and change with every commit.
inline constexpr char kRowChecksum[] =
    "row_checksum(number, name, request_id, epoch, cancel_requested, oldest_sequence, compacted)";

/// Gives a connection the function of kRowChecksum: CRC-32 of its arguments, of any number and
/// type.
void AddRowChecksum(SQLite::Database& connection);

}  // namespace contact
