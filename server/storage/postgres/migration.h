#pragma once

#include <absl/status/status.h>

#include "storage/postgres/connection.h"

namespace contact::postgres {

/// Makes the tables in a new database, or brings those of an older version up to date, as one
/// transaction. FAILED_PRECONDITION: they are newer than this program, or the role may not.
absl::Status Migrate(Connection& connection);

/// FAILED_PRECONDITION: the tables are not those of this program. The message says what to do.
absl::Status CheckVersion(Connection& connection);

}  // namespace contact::postgres
