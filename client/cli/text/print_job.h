#pragma once

#include <string>
#include <vector>

#include "cli/settings/settings.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Writes a JSON document to the standard output, as YAML where -o asks for that.
void PrintJson(const std::string& json, const Settings& settings);

/// Writes a job to the standard output: its name, JSON, or as RenderJob does, as -o asks. `columns`
/// selects columns of the ledger; empty: all.
void PrintJob(const v1::Job& job, const Settings& settings,
              const std::vector<std::string>& columns = {});

/// The exit code for how a job ended; kOk for a job that has not ended.
ExitCode CodeOf(const v1::Job& job);

}  // namespace contact::cli
