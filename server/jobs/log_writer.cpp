#include "jobs/log_writer.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "storage/store.h"

namespace contact {
namespace {

using std::chrono::steady_clock;

// A batch goes to the store when it is large enough to be worth a sync of the disk, or old enough
// for a watcher to notice.
constexpr std::size_t kBatchBytes = 1 << 16;
constexpr std::chrono::milliseconds kBatchTime{20};
// Events that may wait beside the batch that is being written.
constexpr std::size_t kMaxPendingBytes = 2 << 20;
constexpr std::chrono::seconds kRetryTime{1};
// What an event costs in memory beside its content.
constexpr std::size_t kEventBytes = 128;

}  // namespace

LogWriter::LogWriter(Store& store, Place place, RunControl& run, std::stop_token shutdown)
    : store_(store),
      name_(std::move(place.name)),
      log_(std::move(place.log)),
      run_(run),
      shutdown_(std::move(shutdown)),
      epoch_(place.epoch) {}

LogWriter::~LogWriter() {
  const MutexLock lock(mutex_);
  while (disk_ == Disk::kWriting) changed_.wait(mutex_);
}

void LogWriter::Take(v1::Job job, std::vector<v1::Event> events) {
  pending_.take = true;
  pending_.job = std::move(job);
  pending_.events = std::move(events);
  Advance(steady_clock::now());
}

bool LogWriter::Add(v1::Event event) {
  const RunControl::Report report(run_);
  const std::size_t bytes = event.ByteSizeLong();
  if (!report || !run_.CountOutput(static_cast<std::int64_t>(bytes))) return false;
  pending_.bytes += bytes + kEventBytes;
  pending_.events.push_back(std::move(event));
  WriteWhatIsDue();
  return true;
}

void LogWriter::Pump() {
  if (const RunControl::Report report(run_); report) WriteWhatIsDue();
}

void LogWriter::WriteWhatIsDue() {
  const Time now = steady_clock::now();
  if (pending_.bytes >= kBatchBytes || now - last_write_ >= kBatchTime) Advance(now);
  if (pending_.bytes < kMaxPendingBytes) return;
  if (Settle() == Disk::kLost) pending_ = {};
  Advance(now);
}

bool LogWriter::Finish(v1::Job job, v1::Event event, std::function<void()> committed) {
  const RunControl::Report report(run_);
  if (!report) return false;
  pending_.job = std::move(job);
  pending_.events.push_back(std::move(event));
  pending_.committed = std::move(committed);
  Settle();
  Advance(steady_clock::now());
  return Settle() == Disk::kIdle;
}

// Starts the next batch, or tries the last one again, if it is time. Never waits.
void LogWriter::Advance(Time now) {
  Disk disk;
  {
    const MutexLock lock(mutex_);
    disk = disk_;
  }
  if (disk == Disk::kFull && now - last_write_ >= kRetryTime) Send(now);
  if (disk != Disk::kIdle || pending_.events.empty()) return;
  batch_ = std::exchange(pending_, {});
  Send(now);
}

void LogWriter::Send(Time now) {
  last_write_ = now;
  Become(Disk::kWriting);
  store_.Update({.name = name_,
                 .epoch = epoch_,
                 .take = batch_.take,
                 .job = batch_.job ? &*batch_.job : nullptr,
                 .events = batch_.events},
                [this](const absl::StatusOr<std::uint64_t>& first) { Written(first); });
}

// Waits until nothing is being written, or to be tried again.
LogWriter::Disk LogWriter::Settle() {
  for (;;) {
    {
      const MutexLock lock(mutex_);
      while (disk_ == Disk::kWriting) changed_.wait(mutex_);
      if (disk_ != Disk::kFull) return disk_;
      changed_.wait_for(mutex_, shutdown_, kRetryTime, [] { return false; });
      if (shutdown_.stop_requested()) return disk_ = Disk::kLost;
    }
    Send(steady_clock::now());
  }
}

// On the store's thread.
void LogWriter::Written(const absl::StatusOr<std::uint64_t>& first) {
  if (first.ok()) {
    if (batch_.take) ++epoch_;
    log_->Append(*first, std::move(batch_.events));
    if (batch_.committed) batch_.committed();
    return Become(Disk::kIdle);
  }
  if (!std::exchange(batch_.failed, true)) {
    spdlog::error("{}: cannot store events: {}", name_, first.status().ToString());
  }
  if (absl::IsResourceExhausted(first.status())) return Become(Disk::kFull);
  log_->Fail();
  run_.Stop();
  Become(Disk::kLost);
}

void LogWriter::Become(Disk disk) {
  const MutexLock lock(mutex_);
  disk_ = disk;
  changed_.notify_all();  // Under the lock: a waiter may destroy this as soon as it has it.
}

}  // namespace contact
