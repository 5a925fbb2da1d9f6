#pragma once

namespace contact {

class Database;

/// Removes some of the events that Remove and Compact of job_changes.h have taken from sight: at
/// most 32 a call, so that commits go on between the calls. Returns false if there are none. Runs
/// inside the transaction of its caller. SQL errors are thrown as SQLite::Exception.
bool Purge(Database& database);

}  // namespace contact
