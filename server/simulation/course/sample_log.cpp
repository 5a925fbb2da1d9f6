#include "simulation/course/sample_log.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "simulation/model/derived.h"

namespace contact {
namespace {

// A watcher sees samples within a fifth of a second, or a 64th of the time that the run has taken
// if that is more. A clock would hold this better, but a run that goes on after a crash must hand
// out the same chunks. So steps count, which take 30 to 320 ns for each column of the samples
// (tests/system/live_test.py). A chunk more repeats the names of the columns, 45 bytes each: a run
// of a day hands out 700 more, and 800,000 without the 64th (Sampler.ChunksThatFillSlowly…,
// Sampler.TheLongerARunIs…).
constexpr std::int64_t kStepsTimesColumns = 1 << 19;
constexpr std::int64_t kShare = 64;

// The step at which a chunk is handed out that begins at the given one. Rows of many columns come
// in short chunks already.
std::int64_t DueAfter(std::int64_t step, int columns) {
  if (RowsPerChunk(columns) < kSamplesPerChunk) return std::numeric_limits<std::int64_t>::max();
  return step + std::max(kStepsTimesColumns / columns, step / kShare);
}

}  // namespace

SampleLog::SampleLog(const Scenario& scenario, std::stop_token stop,
                     std::function<void(const Samples&)> hand_out)
    : scenario_(scenario), stop_(std::move(stop)), hand_out_(std::move(hand_out)) {
  samples_.columns = SampleColumns(scenario);
  due_ = DueAfter(0, samples_.columns);
  extremes_.resize(static_cast<std::size_t>(scenario.turning_channels));
}

double SampleLog::NextRegular(double instant) const {
  const double interval = scenario_.sample_interval;
  const double time = static_cast<double>(regular_) * interval;
  const bool is_late = time > instant + 1e-9 * interval;
  return is_late || time > scenario_.end_time * (1 + 1e-12) ? kNever : time;
}

bool SampleLog::Begin(double time) {
  if (samples_.rows() == 0 && stop_.stop_requested()) CutShort();
  if (cut_short_) return false;
  samples_.values.push_back(time);
  last_ = time;
  ++next_;
  return true;
}

void SampleLog::End() {
  if (samples_.rows() == RowsPerChunk(samples_.columns)) Flush();
}

void SampleLog::TakeExtremes() {
  const auto is_still = [](const Extremes& e) {
    return e.turns > 1 && e.high.turn.value - e.low.turn.value <= kStill * e.scale;
  };
  const bool misses = std::ranges::any_of(
      extremes_, [&](const Extremes& e) { return e.turns > 1 && !is_still(e); });
  std::vector<Extremes::Row> rows;
  for (Extremes& channel : extremes_) {
    const bool counts = misses && channel.turns > 0 && !is_still(channel);
    channel.turns = 0;
    if (!counts) continue;
    rows.push_back(channel.low);
    rows.push_back(channel.high);
  }
  std::ranges::stable_sort(rows, {}, [](const Extremes::Row& row) { return row.turn.time; });
  for (const Extremes::Row& row : rows) {
    if (row.turn.time <= last_ || !Begin(row.turn.time)) continue;
    samples_.values.insert(samples_.values.end(), row.values.begin(), row.values.end());
    End();
  }
}

void SampleLog::Flush() {
  if (samples_.rows() == 0) return;
  samples_.first = next_ - samples_.rows();
  hand_out_(samples_);
  samples_.values.clear();
  due_ = DueAfter(steps_, samples_.columns);
}

void SampleLog::CutShort() {
  cut_short_ = true;
  samples_.values.clear();  // They would follow a hole.
}

bool SampleLog::full() const {
  const bool asked = scenario_.sample_interval > 0 && scenario_.samples_per_contact > 0;
  return asked && in_cycles_ >= scenario_.most_contact_samples;
}

Sampling SampleLog::Save() const {
  Sampling now{.pending = samples_,
               .regular = regular_,
               .in_cycles = in_cycles_,
               .last = last_,
               .due = due_,
               .extremes = extremes_};
  now.pending.first = next_ - samples_.rows();
  return now;
}

void SampleLog::Restore(Sampling from) {
  next_ = from.pending.first + from.pending.rows();
  regular_ = from.regular;
  in_cycles_ = from.in_cycles;
  last_ = from.last;
  due_ = from.due;
  extremes_ = std::move(from.extremes);
  samples_ = std::move(from.pending);
}

}  // namespace contact
