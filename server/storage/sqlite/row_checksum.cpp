#include "storage/sqlite/row_checksum.h"

#include <sqlite3.h>

#include <cstddef>
#include <string>

#include "storage/checksum.h"

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

void AddRowChecksum(SQLite::Database& connection) {
  connection.createFunction("row_checksum", -1, true, nullptr, RowChecksum, nullptr, nullptr,
                            nullptr);
}

}  // namespace contact
