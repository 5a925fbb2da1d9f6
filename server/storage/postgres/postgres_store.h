#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>

#include "storage/postgres/grants.h"
#include "storage/shared_store.h"

namespace contact {

/// True for an address that OpenPostgres takes: postgresql://… or postgres://….
bool IsPostgresAddress(const std::string& address);

/// Opens the store in a PostgreSQL database, after its tables were made or brought up to date, to
/// use it together with other programs. Of the options the limits of the disk do not count: the
/// database has its own.
/// UNAVAILABLE: the database does not answer, or a program has it for itself. FAILED_PRECONDITION:
/// its tables are newer than this program, or it refuses the user.
absl::StatusOr<std::unique_ptr<SharedStore>> OpenPostgres(const std::string& address,
                                                          StoreOptions options = {});
/// As OpenPostgres, for this program alone. UNAVAILABLE, too: another one uses it.
absl::StatusOr<std::unique_ptr<Store>> OpenPostgresAlone(const std::string& address);

/// Database and server of an address, without secrets, for people.
std::string PostgresName(const std::string& address);

/// Makes the tables of the store in a database, or brings them up to date, and gives the roles what
/// they need. Errors: as OpenPostgres.
absl::Status MigratePostgres(const std::string& address, const postgres::Grants& grants = {});

}  // namespace contact
