#pragma once

#include <string>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"

namespace contact {

/// Text of artifacts: comma-separated values whose first line names the columns as `name [unit]`.
/// Numbers have 17 significant digits.

/// `time [s],B1.position [m],…`
std::string CsvHeader(const v1::FrameChunk& chunk);
/// A line for each sample. Each column has `samples` values.
std::string CsvRows(const v1::FrameChunk& chunk);
/// The ledger: a column for each field of Cycle.
std::string CyclesCsv(const v1::Job& job);
/// The groups of the ledger: a column for each field of Group.
std::string GroupsCsv(const v1::Job& job);

}  // namespace contact
