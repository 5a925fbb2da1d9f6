#include "jobs/run/log_writer.h"

#include <spdlog/spdlog.h>

#include <iterator>
#include <utility>

#include "base/clock.h"
#include "storage/store.h"

namespace contact {
namespace {

// A batch goes to the store when it is large enough to be worth a sync of the disk, or old enough
// for a watcher to notice.
constexpr std::size_t kBatchBytes = 1 << 16;
constexpr std::chrono::milliseconds kBatchTime{20};
// Events that may wait beside the batch that is being written.
constexpr std::size_t kMaxPendingBytes = 2 << 20;
constexpr std::chrono::seconds kRetryTime{1};
// How often a worker that waits for space looks whether it is time to try again.
constexpr std::chrono::milliseconds kLookTime{20};
// What an event costs in memory beside its content.
constexpr std::size_t kEventBytes = 128;

}  // namespace

LogWriter::LogWriter(Store& store, const Clock& clock, Place place, std::shared_ptr<RunControl> run,
                     std::stop_token shutdown)
    : store_(store),
      clock_(clock),
      name_(std::move(place.name)),
      log_(std::move(place.log)),
      run_(std::move(run)),
      shutdown_(std::move(shutdown)),
      epoch_(place.epoch) {}

void LogWriter::Take(v1::Job job, std::vector<v1::Event> events) {
  pending_.take = true;
  pending_.job = std::move(job);
  pending_.events = std::move(events);
  Encode(&pending_);
  take_ = pending_.encoded;
  Advance(clock_.Elapsed());
}

bool LogWriter::Add(v1::Event event) {
  const RunControl::Hold hold(*run_);
  const std::size_t bytes = event.ByteSizeLong();
  if (!hold || !run_->CountOutput(static_cast<std::int64_t>(bytes))) return false;
  pending_.bytes += bytes + kEventBytes;
  pending_.events.push_back(std::move(event));
  WriteDueBatch();
  return true;
}

void LogWriter::AddCheckpoint(std::string state) {
  const RunControl::Hold hold(*run_);
  if (!hold) return;
  pending_.bytes += state.size();
  pending_.checkpoint = Checkpoint{pending_.events.size(), std::move(state)};
  Advance(clock_.Elapsed());
}

void LogWriter::WriteIfDue() {
  if (const RunControl::Hold hold(*run_); hold) WriteDueBatch();
}

void LogWriter::WriteDueBatch() {
  const Time now = clock_.Elapsed();
  if (pending_.bytes >= kBatchBytes || now - last_write_ >= kBatchTime) Advance(now);
  if (pending_.bytes < kMaxPendingBytes) return;
  if (AwaitIdle() == Disk::kLost) pending_ = {};
  Advance(now);
}

bool LogWriter::Finish(v1::Job job, v1::Event event, Ended ended) {
  hold_.emplace(*run_);
  if (!*hold_) return false;
  pending_.job = std::move(job);
  pending_.events.push_back(std::move(event));
  pending_.ended = std::move(ended);
  Encode(&pending_);
  if (store_.Recall(take_)) ResumeTake();
  Disk disk;
  {
    const MutexLock lock(mutex_);
    finishing_ = true;
    disk = disk_;
  }
  if (disk == Disk::kLost) {
    GiveUpStoring();
  } else {
    Advance(clock_.Elapsed());
  }
  return true;
}

void LogWriter::Retry() {
  {
    const MutexLock lock(mutex_);
    if (!finishing_) return;
  }
  Advance(clock_.Elapsed());
}

void LogWriter::Encode(Batch* batch) const {
  batch->encoded = Store::Encode({.name = name_,
                                  .take = batch->take,
                                  .job = batch->job ? &*batch->job : nullptr,
                                  .events = batch->events,
                                  .checkpoint = batch->checkpoint ? &*batch->checkpoint : nullptr});
  batch->records = ToRecords(std::exchange(batch->events, {}));
}

void LogWriter::Advance(Time now) {
  if (BeginWriting(now)) Send();
}

bool LogWriter::BeginWriting(Time now) {
  const MutexLock lock(mutex_);
  if (disk_ == Disk::kFull) {
    if (now - last_write_ < kRetryTime) return false;
  } else {
    const bool some = pending_.encoded || !pending_.events.empty() || pending_.checkpoint;
    if (disk_ != Disk::kIdle || !some) return false;
    batch_ = std::exchange(pending_, {});
  }
  last_write_ = now;
  disk_ = Disk::kWriting;
  return true;
}

void LogWriter::Send() {
  if (!batch_.encoded) Encode(&batch_);
  store_.Update(batch_.encoded, epoch_,
                [self = shared_from_this()](const absl::StatusOr<std::uint64_t>& first) {
                  self->Written(first);
                });
}

// One that has failed may be done, for its answer may have been lost: it is sent as it was.
void LogWriter::ResumeTake() { batch_.failed ? Send() : JoinTake(); }

void LogWriter::JoinTake() {
  pending_.encoded = std::make_shared<const JobChange>(Joined(*take_, *pending_.encoded));
  pending_.take = true;
  batch_.records.insert(batch_.records.end(), std::make_move_iterator(pending_.records.begin()),
                        std::make_move_iterator(pending_.records.end()));
  pending_.records = std::move(batch_.records);
  SetDisk(Disk::kIdle);
}

LogWriter::Disk LogWriter::AwaitIdle() {
  for (;;) {
    {
      const MutexLock lock(mutex_);
      while (disk_ == Disk::kWriting) changed_.wait(mutex_);
      if (disk_ != Disk::kFull) return disk_;
      changed_.wait_for(mutex_, shutdown_, kLookTime, [] { return false; });
      if (shutdown_.stop_requested()) return disk_ = Disk::kLost;
    }
    Advance(clock_.Elapsed());
  }
}

void LogWriter::Written(const absl::StatusOr<std::uint64_t>& first) {
  if (!first.ok()) return Failed(first.status());
  if (batch_.take) ++epoch_;
  log_->Append(*first, std::move(batch_.records));
  batch_.encoded = nullptr;
  if (batch_.ended) {
    batch_.ended(&*batch_.job);
    hold_.reset();
  }
  if (SetDisk(Disk::kIdle)) Advance(clock_.Elapsed());
}

void LogWriter::Failed(const absl::Status& status) {
  if (!std::exchange(batch_.failed, true)) {
    spdlog::error("job={} cannot store events: {}", name_, status.ToString());
  }
  // No space, or a database that is away for a while: both may end.
  if (absl::IsResourceExhausted(status) || absl::IsUnavailable(status)) {
    SetDisk(Disk::kFull);
    return;
  }
  log_->Fail();
  run_->Stop();
  if (SetDisk(Disk::kLost)) GiveUpStoring();
}

void LogWriter::GiveUpStoring() {
  const Ended& ended = batch_.ended ? batch_.ended : pending_.ended;
  ended(nullptr);
  hold_.reset();
}

bool LogWriter::SetDisk(Disk disk) {
  const MutexLock lock(mutex_);
  disk_ = disk;
  changed_.notify_all();
  return finishing_;
}

}  // namespace contact
