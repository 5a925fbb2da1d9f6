#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "storage/postgres/connection.h"

namespace contact::launcher {

/// What there is to do.
struct Demand {
  std::int64_t queued = 0;   ///< Jobs that wait for a worker, and cells of sweeps that run.
  std::int64_t running = 0;  ///< Jobs that a worker has.
};

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
