#include "jobs/run/ending_runs.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "jobs/run/log_writer.h"

namespace contact {
namespace {

constexpr std::size_t kMostBytes = 8 << 20;
// What the smallest job takes until it is stored: its log and record in memory.
constexpr std::size_t kJobBytes = 64 << 10;

}  // namespace

void EndingRuns::Add(std::shared_ptr<LogWriter> writer, std::size_t bytes) {
  const MutexLock lock(mutex_);
  bytes += kJobBytes;
  bytes_ += bytes;
  const LogWriter* const key = writer.get();
  endings_.emplace(key, Ending{std::move(writer), bytes});
}

void EndingRuns::Remove(const LogWriter* writer) {
  const MutexLock lock(mutex_);
  const auto ending = endings_.find(writer);
  if (ending == endings_.end()) return;
  bytes_ -= ending->second.bytes;
  endings_.erase(ending);
  removed_.notify_all();
}

void EndingRuns::AwaitRoom(const std::stop_token& stop) {
  const MutexLock lock(mutex_);
  removed_.wait(mutex_, stop, [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return bytes_ < kMostBytes && !OutOfSpace();
  });
}

bool EndingRuns::OutOfSpace() const {
  return std::ranges::any_of(
      endings_, [](const auto& ending) { return ending.second.writer->out_of_space(); });
}

void EndingRuns::Retry() {
  std::vector<std::shared_ptr<LogWriter>> writers;
  {
    const MutexLock lock(mutex_);
    for (const auto& [key, ending] : endings_) writers.push_back(ending.writer);
  }
  for (const auto& writer : writers) writer->Retry();
}

}  // namespace contact
