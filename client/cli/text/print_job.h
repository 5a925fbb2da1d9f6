#pragma once

#include <string>
#include <vector>

#include "cli/settings/settings.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Writes a JSON document to the standard output, as YAML where that is asked for.
void PrintJson(const std::string& json, const Settings& settings);

/// Writes a job to the standard output in the format asked for; its ledger has only `columns`,
/// unless there are none.
void PrintJob(const v1::Job& job, const Settings& settings,
              const std::vector<std::string>& columns = {});

/// The code for how a job ended: kOk also while it has not.
ExitCode CodeOf(const v1::Job& job);

}  // namespace contact::cli
