#include "jobs/schedule/retention_clock.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <utility>

#include "base/clock.h"
#include "base/replace_file.h"

namespace contact {
namespace {

using std::chrono::seconds;
using Time = RetentionClock::Time;

// Of the time between two processes, what counts at most.
constexpr std::chrono::hours kLongestPause{24};
// Larger differences from the time that has passed are not believed.
constexpr std::chrono::hours kLargestStep{1};

std::optional<Time> Stored(const std::filesystem::path& file) {
  std::int64_t stored = 0;
  if (file.empty() || !(std::ifstream(file) >> stored)) return std::nullopt;
  return Time(seconds(stored));
}

}  // namespace

RetentionClock::RetentionClock(const Clock& clock, std::filesystem::path file)
    : clock_(clock), file_(std::move(file)), seen_(clock.Now()), elapsed_(clock.Elapsed()) {
  if (const auto stored = Stored(file_)) {
    seen_ = std::clamp(seen_, *stored, Time(*stored + kLongestPause));
  }
}

Time RetentionClock::Now() {
  const auto elapsed = clock_.Elapsed();
  seen_ += std::chrono::duration_cast<Time::duration>(elapsed - std::exchange(elapsed_, elapsed));
  const Time wall = clock_.Now();
  if (std::chrono::abs(wall - seen_) <= kLargestStep) seen_ = wall;
  Tell(wall - seen_);
  // Where it cannot be stored, such as on a full disk, the next start counts from an older time.
  if (!file_.empty()) {
    const auto whole = std::chrono::floor<seconds>(seen_.time_since_epoch());
    ReplaceFile(file_, fmt::format("{}\n", whole.count()), 0600);
  }
  return std::min(wall, seen_);
}

void RetentionClock::Tell(std::chrono::duration<double> ahead) {
  const bool far = ahead > kLargestStep;
  if (!std::exchange(told_, far) && far) {
    spdlog::warn(
        "the clock is {:.1f} h ahead of the time that has passed, and no job grows old by that; if "
        "it is right, remove the file clock of the data directory and start again",
        ahead.count() / 3600);
  }
}

}  // namespace contact
