#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// A series for people: a line a sample in its units; of many samples the middle is left out.
std::string RenderSeries(const v1::Series& series, const Style& style);

/// A series as CSV: a header such as `time [s],B1.velocity [m/s]`, and every sample with as many
/// digits as give the same double back.
std::string SeriesCsv(const v1::Series& series);

/// A series as one JSON document: name, samples, recorded_samples, `sampling` unless it is empty,
/// and columns with name, quantity, unit and values, NaN being null.
std::string SeriesJson(const v1::Series& series, const std::string& sampling = "");

}  // namespace contact::cli
