#pragma once

#include <cstddef>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"

namespace contact {

/// What GetSeries is to return of a trajectory.
struct SeriesSelection {
  /// Indices of columns of the trajectory; the first is the time.
  std::vector<int> columns;
  /// Whether no channel was named: what is not recorded is left out then.
  bool all = false;
  /// Earliest time of a sample [s].
  double start_time = 0;
  /// Latest time of a sample [s].
  double end_time = 0;
  /// Samples in the answer, at most.
  std::size_t max_rows = 0;
  /// True for every sample; else the series is thinned so that no peak is lost.
  bool raw = false;
  /// True for columns of numbers, else of bytes.
  bool plain_numbers = false;
};

/// Reads the request for a trajectory with these columns; FIELD_INVALID if it breaks a rule of
/// job_service.proto, SERIES_TOO_LARGE if not even the fewest points would fit into an answer.
Result<SeriesSelection> ToSelection(const v1::GetSeriesRequest& request,
                                    const std::vector<v1::FrameChunk::Column>& channels);

/// The error of a request for these columns of a job of a server that did not record them yet.
Error NotRecorded(const std::vector<v1::FrameChunk::Column>& channels);

}  // namespace contact
