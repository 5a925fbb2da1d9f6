#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Recorded motion for people: one line a sample, the middle of many left out.
std::string RenderSeries(const v1::Series& series, const Style& style);

/// The same as CSV: a header with the units in its names, such as `B1.velocity_m_per_s`, and every
/// sample with all its digits.
std::string SeriesCsv(const v1::Series& series);

/// The same as one JSON document, its values as numbers.
std::string SeriesJson(const v1::Series& series);

}  // namespace contact::cli
