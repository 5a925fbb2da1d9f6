#include "launcher/demand.h"

#include <utility>

#include "storage/postgres/worker_statements.h"

namespace contact::launcher {

absl::StatusOr<Demand> DemandReader::Read() {
  if (absl::Status status = Connect(); !status.ok()) return status;
  const auto rows = connection_->Run(postgres::Count());
  if (!rows.ok()) {
    // Also one that stands: it may be half-way in an answer, or that of a standby.
    if (absl::IsUnavailable(rows.status())) connection_.reset();
    return rows.status();
  }
  if (rows->size() != 1) return absl::InternalError("contactd.demand() does not answer one row");
  return postgres::DemandOf(*rows);
}

absl::Status DemandReader::Connect() {
  if (connection_ && connection_->good()) return absl::OkStatus();
  auto opened = postgres::Connection::Open(address_);
  if (!opened.ok()) return opened.status();
  connection_ = *std::move(opened);
  return absl::OkStatus();
}

}  // namespace contact::launcher
