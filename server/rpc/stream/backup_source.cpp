#include "rpc/stream/backup_source.h"

#include <cstddef>
#include <string>
#include <utility>

#include "jobs/job/errors.h"

namespace contact {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{256} * 1024;

}  // namespace

class BackupReader::Source final : public StreamSource<v1::BackupChunk> {
 public:
  explicit Source(std::shared_ptr<BackupReader> reader)
      : reader_(std::move(reader)), busy_(reader_->busy_) {}
  ~Source() override { reader_->stop_.request_stop(); }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  StreamStep Read(v1::BackupChunk* out) override { return reader_->Take(out); }

 private:
  const std::shared_ptr<BackupReader> reader_;
  const std::shared_ptr<const void> busy_;
};

std::unique_ptr<StreamSource<v1::BackupChunk>> BackupReader::MakeSource() {
  return std::make_unique<Source>(shared_from_this());
}

void BackupReader::Begin(absl::StatusOr<std::unique_ptr<BackupFile>> file) {
  busy_.reset();
  if (file.ok()) {
    file_ = *std::move(file);
    return Prepare();
  }
  // Nobody asks any more, or the store is being closed.
  const bool cancelled = absl::IsCancelled(file.status());
  {
    const MutexLock lock(mutex_);
    step_ = {.error = cancelled ? MakeError(Reason::kServerDraining) : ToError(file.status(), "")};
  }
  wake_();
}

void BackupReader::Prepare() {
  executor_.Post([self = shared_from_this()] {
    if (self->stop_.stop_requested()) return;
    v1::BackupChunk chunk;
    StreamStep step = self->ReadChunk(&chunk);
    {
      const MutexLock lock(self->mutex_);
      self->chunk_ = std::move(chunk);
      self->step_ = std::move(step);
    }
    self->wake_();
  });
}

StreamStep BackupReader::ReadChunk(v1::BackupChunk* chunk) {
  absl::StatusOr<std::string> bytes = file_->Read(offset_, kChunkBytes);
  if (!bytes.ok()) return {.error = ToError(bytes.status(), "")};
  chunk->set_offset(offset_);
  chunk->set_crc32c(Crc32c(*bytes));
  digest_.Add(*bytes);
  offset_ += static_cast<std::int64_t>(bytes->size());
  chunk->set_data(*std::move(bytes));
  if (offset_ < file_->size()) return {.has_message = true};
  chunk->set_total_bytes(offset_);
  chunk->set_sha256(digest_.Finish());
  return {.has_message = true, .ended = true};
}

StreamStep BackupReader::Take(v1::BackupChunk* out) {
  StreamStep step;
  {
    const MutexLock lock(mutex_);
    if (!step_) return {};
    step = *std::exchange(step_, std::nullopt);
    out->Swap(&chunk_);
  }
  if (!step.ended && !step.error) Prepare();
  return step;
}

}  // namespace contact
