#pragma once

#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <utility>

#include "storage/postgres/connection.h"
#include "storage/shared_store.h"

namespace contact::launcher {

/// Reads the demand of a database, with a new connection if the old one is lost.
class DemandReader {
 public:
  /// `address`: as Connection::Open takes it.
  explicit DemandReader(std::string address) : address_(std::move(address)) {}

  /// Errors: as of Connection.
  absl::StatusOr<Demand> Read();

 private:
  absl::Status Connect();

  const std::string address_;
  std::unique_ptr<postgres::Connection> connection_;
};

}  // namespace contact::launcher
