#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace contact {

/// Brings the tables of an older schema version up to kSchemaVersion in one transaction: a crash
/// leaves all of the old or all of the new. `version`: of the tables now, at least 1. SQL errors
/// are thrown as SQLite::Exception.
void Migrate(SQLite::Database& connection, int version);

}  // namespace contact
