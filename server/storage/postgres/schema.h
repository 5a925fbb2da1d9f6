#pragma once

namespace contact::postgres {

/// Version of the tables and functions below, kept in the table `version`. A change of any raises
/// it by 1; one of the tables adds a step to migration.cpp, too.
inline constexpr int kSchemaVersion = 6;

/// Makes the tables in the schema `contactd`. Meaning of each: ../README.md.
extern const char kTables[];

/// Makes or replaces the functions by which the tables are changed and read. Each is one
/// transaction's worth of work that needs no answer in between, so many go to the server together.
extern const char kFunctions[];

/// The functions that read the tables for fronts and tools.
extern const char kReaderFunctions[];

/// The functions by which processes share the jobs that have not ended.
extern const char kWorkerFunctions[];

}  // namespace contact::postgres
