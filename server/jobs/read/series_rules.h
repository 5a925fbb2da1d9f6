#pragma once

#include <cstddef>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"

namespace contact {

/// What GetSeries is to return of a trajectory.
struct SeriesSelection {
  std::vector<int> columns;  ///< Among those of the trajectory; the first is the time.
  double start_time = 0;     ///< [s], itself included.
  double end_time = 0;       ///< [s], itself included.
  std::size_t max_rows = 0;
  bool raw = false;  ///< Every sample; else thinned so that no peak is lost.
};
/// Reads the request for a trajectory with these columns; FIELD_INVALID if it breaks a rule of
/// job_service.proto, SERIES_TOO_LARGE if not even the fewest points would fit into an answer.
Result<SeriesSelection> ToSelection(const v1::GetSeriesRequest& request,
                                    const std::vector<v1::FrameChunk::Column>& channels);

}  // namespace contact
