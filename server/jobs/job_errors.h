#pragma once

#include <absl/status/status.h>

#include <string>

#include "jobs/error.h"

namespace contact {

/// The errors of job_service.proto that concern whole calls.
Error Draining();
Error QueueFull(int max_queued_jobs);
Error WatcherLimit(int max_watchers);
Error SweepNotAvailable();

/// What a failed operation of the store on the job `name` (may be empty) means for its caller.
Error ToError(const absl::Status& status, const std::string& name);

}  // namespace contact
