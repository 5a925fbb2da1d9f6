#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>

#include "base/digest.h"
#include "base/executor.h"
#include "base/mutex.h"
#include "contact/v1/admin_service.pb.h"
#include "jobs/job/callback.h"
#include "jobs/log/stream_source.h"
#include "storage/backup_file.h"

namespace contact {

/// Reads and hashes a backup in chunks of 256 KiB on an executor's thread, one chunk ahead of the
/// client, because gRPC's threads must not wait for the disk. Owned by the tasks that it posts and
/// by its source.
class BackupReader : public std::enable_shared_from_this<BackupReader> {
 public:
  /// `busy` is held until the copy is complete and, by the source, until
  /// the stream ends. The executor outlives Begin.
  BackupReader(Executor& executor, Wake wake, std::shared_ptr<const void> busy)
      : executor_(executor), wake_(std::move(wake)), busy_(std::move(busy)) {}

  /// A source that reads from here. Its destruction stops the copy. To be called once, before
  /// Begin.
  std::unique_ptr<StreamSource<v1::BackupChunk>> MakeSource();

  /// Stopped when nobody needs the copy any more.
  std::stop_token stop_token() const { return stop_.get_token(); }

  /// Takes the copy, or the reason why there is none, and starts to read. Thread-safe, once.
  void Begin(absl::StatusOr<std::unique_ptr<BackupFile>> file);

 private:
  /// The stream's end: its destruction stops the copy.
  class Source;

  /// Posts the reading of the next chunk.
  void Prepare();
  /// Reads and hashes the next chunk, on the executor's thread.
  StreamStep ReadChunk(v1::BackupChunk* chunk);
  /// Gives the client the chunk that is ready, and prepares the next one.
  StreamStep Take(v1::BackupChunk* out);

  Executor& executor_;
  const Wake wake_;
  /// Stopped when the stream ends.
  std::stop_source stop_;
  /// Held until the copy is complete. Null from Begin on.
  std::shared_ptr<const void> busy_;

  // Of the executor's thread.
  std::unique_ptr<BackupFile> file_;
  /// Bytes read so far.
  std::int64_t offset_ = 0;
  /// Digest of the bytes read so far.
  Sha256 digest_;

  Mutex mutex_;
  /// The next chunk. Empty while step_ is null.
  v1::BackupChunk chunk_ ABSL_GUARDED_BY(mutex_);
  /// What Take gives next. Nothing: it is not ready.
  std::optional<StreamStep> step_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
