#pragma once

#include "cli/settings/settings.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Prints a line for each job that `request` selects, then a line for each change, until Ctrl-C or
/// --timeout. Returns kInterrupted or kTimeout. Throws Failure (kUsage) unless the output is a
/// table or JSON lines, and CallFailure.
ExitCode ListAndWatch(const v1::WatchJobsRequest& request, const Settings& settings);

}  // namespace contact::cli
