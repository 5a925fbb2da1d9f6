#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/comparison/verification.h"

namespace contact::cli {

/// A verification for people: the runs, a row for each number, and what follows. Names a run only
/// if `kept`, or if it is the job.
std::string RenderVerification(const Verification& verification, bool kept, const Style& style);

/// The same as one JSON document: job, field, runs, tolerance, holds, differences, numbers. A
/// number that is not finite is null.
std::string VerificationJson(const Verification& verification, bool kept);

}  // namespace contact::cli
