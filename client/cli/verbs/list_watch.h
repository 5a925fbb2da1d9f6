#pragma once

#include "cli/settings/settings.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Shows the jobs of a filter, and then a line for each change, until Ctrl-C or --timeout.
ExitCode ListAndWatch(const v1::WatchJobsRequest& request, const Settings& settings);

}  // namespace contact::cli
