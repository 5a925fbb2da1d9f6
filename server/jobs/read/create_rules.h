#pragma once

#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/budget.h"
#include "wire/rules/violation.h"

namespace contact {

/// Violations of the rules that job_service.proto gives for CreateJob, except those of the scenario
/// or sweep. `max_budget` is the largest budget that a job may ask for.
std::vector<Violation> CheckCreate(const v1::CreateJobRequest& request,
                                   const RunBudget& max_budget = {});

}  // namespace contact
