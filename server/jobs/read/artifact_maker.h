#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/digest.h"
#include "base/mutex.h"
#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/read/artifact_plan.h"
#include "storage/store.h"

namespace contact {

class Executor;

/// Makes the chunks of one artifact, some at each call of Continue. It first looks for the part of
/// the log that has the samples, then turns them into text. Belongs to the executor while it works;
/// work that is under way ends when the last reference goes.
class ArtifactMaker : public std::enable_shared_from_this<ArtifactMaker> {
 public:
  ArtifactMaker(Store& store, Executor& executor, ArtifactPlan plan, std::function<void()> wake);

  /// Chunks that wait for the reader, and the state of the making.
  struct Made {
    std::deque<v1::ReadArtifactResponse> chunks;  ///< The last one has the artifact.
    bool working = false;
    std::optional<Error> error;
  };
  /// Calls `access` with the Made, under its lock.
  template <class Access>
  void Do(Access access) {
    const MutexLock lock(mutex_);
    access(made_);
  }

  /// Starts to make the next chunks and calls `wake` when some are there. Not to be called while
  /// Made::working is true.
  void Continue();

 private:
  using Page = absl::StatusOr<EventPage>;

  void Post(std::function<void(ArtifactMaker&)> work);
  void ReadPage(std::uint32_t kinds, void (ArtifactMaker::*take)(const Page&));
  void Look(const Page& page);
  void Note(const StoredEvent& event, const v1::Event& content);
  void Write(const Page& page);
  bool Write(const StoredEvent& event);
  void Emit(const std::string& text);
  void Finish();
  void Fail(Error error);
  void Pause();

  Store& store_;
  Executor& executor_;
  ArtifactPlan plan_;  // Its result is merged once, on the executor.
  const std::function<void()> wake_;

  // Owned by the executor task that is running.
  bool looked_ = false;         ///< True once position_ and end_ enclose the samples.
  std::uint64_t position_ = 0;  ///< Sequence of the last event that was read.
  std::uint64_t end_ = 0;       ///< Sequence of the last event with samples of the artifact.
  std::uint64_t boundary_ =
      0;                     ///< Last event seen that ends the samples of another attempt or cell.
  std::uint64_t begin_ = 0;  ///< The samples of the artifact come after this sequence.
  std::int64_t size_ = 0;    ///< Bytes made, including those before the requested offset.
  Sha256 digest_;

  Mutex mutex_;
  Made made_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
