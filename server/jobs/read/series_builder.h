#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/read/decimation.h"
#include "jobs/read/series_rules.h"
#include "wire/chunk_columns.h"

namespace contact {

/// Makes the answer of GetSeries of the frame chunks of a trajectory, given in order.
class SeriesBuilder {
 public:
  /// `channels` are all columns of the trajectory, of which one of an older server has the `first`
  /// ones only.
  SeriesBuilder(SeriesSelection selection, std::vector<v1::FrameChunk::Column> channels,
                std::size_t first);

  /// Forgets the chunks so far: another attempt begins.
  void Restart();
  /// True if the chunk may be one of this trajectory.
  bool Fits(const v1::FrameChunk& chunk) const;
  /// Adds the samples of a chunk that lie in the time range. False if the chunk does not fit.
  bool Add(const v1::FrameChunk& chunk);
  /// True if the chunk, which fits, ends before the time range.
  bool IsBefore(const v1::FrameChunk& chunk) const;
  /// True if the chunk, which fits, begins after the time range.
  bool IsPast(const v1::FrameChunk& chunk) const;
  /// The series of all chunks added; SERIES_TOO_LARGE if it has more samples than may be answered,
  /// FIELD_INVALID if it was asked for channels that the chunks lack.
  Result<v1::Series> Finish() const;

 private:
  /// Leaves out what chunks of so many columns lack. False if no trajectory has so many.
  bool Narrow(std::size_t columns);
  /// Adds samples of a chunk with all columns: `count` from `first` on.
  void AddRows(const v1::FrameChunk& chunk, std::size_t first, std::size_t count);
  /// True if there are more samples than may be answered.
  bool TooLarge() const;

  const SeriesSelection selection_;
  const std::vector<v1::FrameChunk::Column> channels_;
  const std::size_t first_;
  /// Those of the selection that the chunks have.
  std::vector<int> columns_;
  /// Named in the request, and not in the chunks.
  std::vector<v1::FrameChunk::Column> missing_;
  ColumnJoiner joiner_;
  /// Nothing for RAW.
  std::optional<MinMaxDecimator> decimator_;
  /// The values of each selected column. Only for RAW; stops growing when it is too large.
  std::vector<std::string> raw_;
  /// Samples in the time range.
  std::size_t recorded_ = 0;
};

}  // namespace contact
