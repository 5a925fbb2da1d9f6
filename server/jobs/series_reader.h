#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "contact/v1/job_service.pb.h"
#include "jobs/decimation.h"
#include "jobs/error.h"
#include "jobs/request_rules.h"
#include "storage/store.h"

namespace contact {

class Executor;

/// Makes the answer of GetSeries of the frame chunks of a trajectory, given in order.
class SeriesBuilder {
 public:
  SeriesBuilder(SeriesSelection selection, std::vector<v1::FrameChunk::Column> channels);

  /// Forgets the chunks so far: another attempt begins.
  void Restart();
  /// False: the chunk is not one of this trajectory.
  bool Add(const v1::FrameChunk& chunk);
  /// SERIES_TOO_LARGE.
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
  void Open(const absl::StatusOr<StoredJob>& stored);
  void ReadPage();
  void Take(const absl::StatusOr<EventPage>& page);
  bool Take(const StoredEvent& stored);

  Store& store_;
  Executor& executor_;
  const ScenarioLimits limits_;
  const v1::GetSeriesRequest request_;
  const Caller caller_;
  std::optional<SeriesBuilder> builder_;
  std::uint64_t position_ = 0;
  std::uint64_t last_ = 0;  ///< What comes after it while we read is left to the next call.
};

}  // namespace contact
