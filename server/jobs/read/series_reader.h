#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/read/decimation.h"
#include "jobs/read/series_rules.h"
#include "storage/store.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

class Executor;

/// Makes the answer of GetSeries of the frame chunks of a trajectory, given in order.
class SeriesBuilder {
 public:
  SeriesBuilder(SeriesSelection selection, std::vector<v1::FrameChunk::Column> channels);

  /// Forgets the chunks so far: another attempt begins.
  void Restart();
  /// True if the chunk is one of this trajectory.
  bool Fits(const v1::FrameChunk& chunk) const;
  /// Adds the samples of a chunk that lie in the time range. False if the chunk does not fit.
  bool Add(const v1::FrameChunk& chunk);
  /// True if the time range ends before the chunk.
  bool IsPast(const v1::FrameChunk& chunk) const;
  /// The series of all chunks added; SERIES_TOO_LARGE if it has more samples than may be answered.
  Result<v1::Series> Finish() const;

 private:
  void AddRow(const v1::FrameChunk& chunk, int row);

  const SeriesSelection selection_;
  const std::vector<v1::FrameChunk::Column> channels_;
  std::optional<MinMaxDecimator> decimator_;  ///< None for RAW.
  std::vector<double> rows_;                  ///< For RAW; stops growing when it is too large.
  std::int64_t recorded_ = 0;
};

/// Reads recorded motion from the log of a job, page by page. Waits for nothing: between the pages
/// other work of the executor has its turn. Owns itself until `done` is called.
///
/// Of a time range only the chunks in it are read: times grow along the log of an attempt, so the
/// place where the range begins is found by halving.
class SeriesReader : public std::enable_shared_from_this<SeriesReader> {
 public:
  /// Who waits for the answer.
  struct Caller {
    std::function<void(Result<v1::Series>)> done;
    std::function<bool()> abandoned;  ///< Nobody does any more; may be empty.
  };

  /// Store and executor outlive the reading.
  static void Read(Store& store, Executor& executor, const ScenarioLimits& limits,
                   const v1::GetSeriesRequest& request, Caller caller);

 private:
  SeriesReader(Store& store, Executor& executor, const ScenarioLimits& limits,
               v1::GetSeriesRequest request, Caller caller);
  using Page = absl::StatusOr<EventPage>;

  void Open(const absl::StatusOr<StoredJob>& stored);
  void ReadEvents(EventQuery query, void (SeriesReader::*take)(const Page&));
  void ReadPage();
  void Take(const Page& page);
  bool Take(const StoredEvent& stored);

  void FindAttempt();
  void TakeAttempts(const Page& page);
  void Halve();
  void TakeProbe(const Page& page);

  Store& store_;
  Executor& executor_;
  const ScenarioLimits limits_;
  const v1::GetSeriesRequest request_;
  const Caller caller_;
  std::optional<SeriesBuilder> builder_;
  std::uint64_t position_ = 0;
  std::uint64_t last_ = 0;  ///< Last sequence when the reading began; later events are left out.
  bool past_end_ = false;   ///< A chunk began after the time range.

  // Bisection of the log for the first chunk of the time range.
  double start_time_ = 0;    ///< [s] Start of the time range.
  std::uint64_t low_ = 0;    ///< Chunks up to this sequence end before start_time_.
  std::uint64_t high_ = 0;   ///< Chunks after this sequence end at start_time_ or later.
  std::uint64_t probe_ = 0;  ///< The sequence that is being probed, between low_ and high_.
};

}  // namespace contact
