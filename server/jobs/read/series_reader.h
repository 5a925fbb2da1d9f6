#pragma once

#include <absl/status/statusor.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/callback.h"
#include "jobs/read/few_at_once.h"
#include "jobs/read/series_builder.h"
#include "storage/store.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

class Executor;

/// Reads recorded motion from the log of a job, page by page. Waits for nothing: between the pages
/// other work of the executor has its turn. Owns itself until it has answered.
///
/// Of a time range only the chunks in it are read: times grow along the log of an attempt, so the
/// place where the range begins is found by halving.
class SeriesReader : public std::enable_shared_from_this<SeriesReader> {
 public:
  /// Store, executor and `large`, which lets few large series be made at a time, outlive the
  /// reading. The job is one of the tenant.
  SeriesReader(Store& store, Executor& executor, FewAtOnce& large, const ScenarioLimits& limits,
               std::string tenant, v1::GetSeriesRequest request, Callback<v1::Series> done,
               Abandoned abandoned);

  /// Starts to read. To be called once.
  void Start();

 private:
  using Page = absl::StatusOr<EventPage>;

  /// Checks the request against the job.
  void Open(const absl::StatusOr<StoredJob>& stored);
  /// Begins with the log of the job, which was taken so many times.
  void Begin(std::uint64_t attempts);
  /// Runs the work on the executor; answers SERVER_DRAINING if that has stopped.
  void Post(std::function<void()> work);
  /// Reads the events of these kinds after position_, and posts `take` with them.
  void ReadEvents(std::uint32_t kinds, std::size_t max_bytes,
                  void (SeriesReader::*take)(const Page&));
  /// Reads the next page of the trajectory.
  void ReadPage();
  /// Adds a page of the trajectory, while the store reads the one after it.
  void Take(const Page& page);
  /// Answers, unless that was done: a page that is read ahead may come after the answer.
  void Answer(Result<v1::Series> series);
  /// Adds one event of the trajectory. False if it is damaged.
  bool Take(const StoredEvent& stored);

  /// Looks for the last attempt, which begins the log that counts.
  void FindAttempt();
  void TakeAttempts(const Page& page);
  /// Looks for the place in the last attempt where the time range begins.
  void FindStart();
  /// Probes the middle between low_ and high_, or begins to read if there is none.
  void Halve();
  /// Reads the first chunk after position_.
  void Probe();
  void TakeProbe(const Page& page);

  Store& store_;
  Executor& executor_;
  FewAtOnce& large_;
  const ScenarioLimits limits_;
  const std::string tenant_;
  const v1::GetSeriesRequest request_;
  const Callback<v1::Series> done_;
  const Abandoned abandoned_;
  std::atomic<bool> answered_ = false;

  // Owned by the executor task that is running.

  /// Of a large series, from Begin to the answer.
  FewAtOnce::Place place_;
  /// Nothing before Open.
  std::optional<SeriesBuilder> builder_;
  /// Sequence of the last event that was read.
  std::uint64_t position_ = 0;
  /// Last sequence when the reading began; later events are left out.
  std::uint64_t last_ = 0;
  /// True once a chunk has begun after the time range.
  bool past_end_ = false;
  /// Chunks up to this sequence end before the time range.
  std::uint64_t low_ = 0;
  /// Chunks after this sequence do not end before the time range.
  std::uint64_t high_ = 0;
  /// The sequence that is being probed, between low_ and high_.
  std::uint64_t probe_ = 0;
};

}  // namespace contact
