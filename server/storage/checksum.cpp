#include "storage/checksum.h"

#include <sqlite3.h>
#include <zlib.h>

#include <cstddef>

namespace contact {
namespace {

// Every value as its type, its text and an end, so that none can pass for two others.
void RowChecksum(sqlite3_context* context, int count, sqlite3_value** arguments) {
  std::string row;
  for (int i = 0; i < count; ++i) {
    row += static_cast<char>(sqlite3_value_type(arguments[i]));
    if (const unsigned char* text = sqlite3_value_text(arguments[i])) {
      row.append(reinterpret_cast<const char*>(text),
                 static_cast<std::size_t>(sqlite3_value_bytes(arguments[i])));
    }
    row += '\0';
  }
  sqlite3_result_int64(context, Checksum(row));
}

}  // namespace

std::int64_t Checksum(const std::string& bytes, std::uint64_t place) {
  const uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(&place), sizeof place);
  return static_cast<std::int64_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence) {
  constexpr int kAboveSequences = 56;  // A log never has so many events.
  return Checksum(event.bytes, sequence | static_cast<std::uint64_t>(event.coding)
                                              << kAboveSequences);
}

void AddRowChecksum(SQLite::Database& connection) {
  connection.createFunction("row_checksum", -1, true, nullptr, RowChecksum, nullptr, nullptr,
                            nullptr);
}

}  // namespace contact
