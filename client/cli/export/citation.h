#pragma once

#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Two BibTeX entries: the paper whose method the server computes with, and the run or sweep `job`,
/// with its year, the version and revision of the contactd that computed it, and the SHA-256 of its
/// scenario.
std::string BibTeX(const v1::Job& job);

}  // namespace contact::cli
