#pragma once

#include <absl/status/status.h>

#include "storage/postgres/connection.h"
#include "storage/postgres/grants.h"

namespace contact::postgres {

/// Makes the tables in a new database, or brings those of an older version up to date, and gives
/// the roles what they need: all of it in one transaction, or nothing. Waits while another program
/// does it. FAILED_PRECONDITION: the tables are newer than this program, or the role may not; the
/// message says what to do.
absl::Status Migrate(Connection& connection, const Grants& grants = {});

}  // namespace contact::postgres
