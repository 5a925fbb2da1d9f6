#pragma once

#include <google/protobuf/map.h>

#include <string>
#include <vector>

#include "wire/rules/violation.h"

namespace contact {

/// Labels of a job, or those that a filter asks for.
using Labels = google::protobuf::Map<std::string, std::string>;

/// Adds the violations of the rules that job.proto gives for labels: their number, and the letters
/// and lengths of keys and values.
void CheckLabels(const Labels& labels, std::vector<Violation>* violations);

}  // namespace contact
