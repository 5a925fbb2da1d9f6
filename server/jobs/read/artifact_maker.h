#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/digest.h"
#include "base/mutex.h"
#include "contact/v1/job_service.pb.h"
#include "jobs/job/callback.h"
#include "jobs/log/stream_source.h"
#include "jobs/quota/message_bytes.h"
#include "jobs/read/artifact_plan.h"
#include "jobs/read/few_at_once.h"
#include "storage/store.h"
#include "wire/chunk_columns.h"

namespace contact {

class Executor;

/// Makes the chunks of one artifact, some at a time. It first looks for the part of the log that
/// has the samples, then turns them into text. Works on the executor; work that is under way ends
/// when the last reference goes.
class ArtifactMaker : public std::enable_shared_from_this<ArtifactMaker> {
 public:
  /// `wake` is called when there may be something to take. Chunks keep to `message_bytes`, and what
  /// is made at once about to it; it works when `turns` lets it. All of these outlive the maker.
  ArtifactMaker(Store& store, Executor& executor, FewAtOnce& turns, ArtifactPlan plan, Wake wake,
                MessageBudget message_bytes);

  /// Moves the next chunk to `out`. If there is none, it starts to make the next ones, unless that
  /// is under way. Never blocks. The last chunk has the artifact with size and SHA-256.
  StreamStep Take(v1::ReadArtifactResponse* out);

 private:
  using Page = absl::StatusOr<EventPage>;

  /// Starts to make the next chunks.
  void Continue();
  /// Runs the work on the executor, unless the reader has left by then.
  void Post(std::function<void(ArtifactMaker&)> work);
  /// Reads the events of these kinds after position_, and posts `take` with them.
  void ReadPage(std::uint32_t kinds, void (ArtifactMaker::*take)(const Page&));
  /// Looks for the samples of the last attempt, or for those that stand before the cell.
  void Look(const Page& page);
  /// Updates the place of the samples with an event that ends those before it.
  void Note(const StoredEvent& event, const v1::Event& content);
  /// Makes text of the frame chunks of a page.
  void Write(const Page& page);
  /// Makes text of one frame chunk. False if it is damaged.
  bool Write(const StoredEvent& event);
  /// Adds text. All of it counts; what lies behind the requested offset becomes chunks.
  void Emit(const std::string& text);
  /// Adds the last chunk, or fails if there is nothing to read.
  void Finish();
  void Add(v1::ReadArtifactResponse chunk);
  void Fail(Error error);
  /// Ends the work that Take has started, and wakes the reader.
  void Pause();

  Store& store_;
  Executor& executor_;
  FewAtOnce& turns_;
  const Wake wake_;
  const MessageBudget message_bytes_;

  // Owned by the executor task that is running.

  /// Its result is merged once, on the executor.
  ArtifactPlan plan_;
  /// True once position_ and end_ enclose the samples.
  bool looked_ = false;
  /// Sequence of the last event that was read.
  std::uint64_t position_ = 0;
  /// Sequence of the last event with samples of the artifact.
  std::uint64_t end_ = 0;
  /// Sequence of the last event seen that ends the samples of another attempt or cell.
  std::uint64_t boundary_ = 0;
  /// The samples of the artifact come after this sequence.
  std::uint64_t begin_ = 0;
  ColumnJoiner joiner_;
  /// Bytes made, including those before the requested offset.
  std::int64_t size_ = 0;
  /// Digest of the bytes made.
  Sha256 digest_;

  Mutex mutex_;
  /// Chunks that wait for the reader.
  std::deque<v1::ReadArtifactResponse> chunks_ ABSL_GUARDED_BY(mutex_);
  /// True from Take to Pause.
  bool working_ ABSL_GUARDED_BY(mutex_) = false;
  /// While it works, or waits for the store.
  FewAtOnce::Place turn_ ABSL_GUARDED_BY(mutex_);
  std::optional<Error> error_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
