#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace contact {

/// SQL expression on a row of jobs: the checksum of its columns that stand nowhere else, which
/// row_crc32 holds. Of the others state, owner, tenant and end_time repeat the header;
/// last_sequence and bytes follow from the log, and change with every commit.
inline constexpr char kRowChecksum[] =
    "row_checksum(number, name, request_id, epoch, cancel_requested, oldest_sequence, compacted)";

/// Gives a connection the function of kRowChecksum: CRC-32 of its arguments, of any number and
/// type.
void AddRowChecksum(SQLite::Database& connection);

}  // namespace contact
