#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// Recorded motion for people: one line a sample, the middle of many left out.
std::string RenderSeries(const v1::Series& series, const Style& style);

/// Recorded motion as CSV: a header such as `time [s],B1.velocity [m/s]`, and every sample with as
/// many digits as give the same double back.
std::string SeriesCsv(const v1::Series& series);

/// The same as one JSON document, its values as numbers.
std::string SeriesJson(const v1::Series& series);

}  // namespace contact::cli
