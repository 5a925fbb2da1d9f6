#pragma once

#include <libpq-fe.h>

#include <cstdint>
#include <memory>
#include <string>

namespace contact::postgres {

/// What a statement answered, in PostgreSQL's binary format. Rows and columns are counted from 0.
class Rows {
 public:
  Rows() = default;
  explicit Rows(PGresult* result) : result_(result, PQclear) {}

  /// False: the statement failed, or there is no answer.
  bool ok() const;
  const PGresult* raw() const { return result_.get(); }

  int size() const { return PQntuples(result_.get()); }
  bool IsNull(int row, int column) const { return PQgetisnull(result_.get(), row, column) != 0; }
  /// A smallint, integer, bigint or boolean; 0 for NULL.
  std::int64_t Integer(int row, int column) const;
  /// A text or bytea; empty for NULL.
  std::string Bytes(int row, int column) const {
    return {PQgetvalue(result_.get(), row, column),
            static_cast<std::size_t>(PQgetlength(result_.get(), row, column))};
  }

 private:
  std::shared_ptr<PGresult> result_;
};

}  // namespace contact::postgres
