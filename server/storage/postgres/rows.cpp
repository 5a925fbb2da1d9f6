#include "storage/postgres/rows.h"

namespace contact::postgres {

bool Rows::ok() const {
  const ExecStatusType status = PQresultStatus(result_.get());
  return status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK;
}

std::int64_t Rows::Integer(int row, int column) const {
  const char* bytes = PQgetvalue(result_.get(), row, column);
  const int size = PQgetlength(result_.get(), row, column);
  if (size == 0) return 0;
  const auto byte = [bytes](int i) { return static_cast<unsigned char>(bytes[i]); };
  std::int64_t value = byte(0) < 0x80 ? 0 : -1;  // The sign.
  for (int i = 0; i < size; ++i) value = value * 256 + byte(i);
  return value;
}

}  // namespace contact::postgres
