#pragma once

#include <string>

#include "contact/v1/job.pb.h"

namespace contact {

/// The `spec_sha256` of a job with this spec, as job.proto defines it: 64 hexadecimal digits. Empty
/// without a spec.
std::string SpecSha256(const v1::Job& job);

}  // namespace contact
