#include "jobs/run/run_recorder.h"

#include <algorithm>
#include <cstddef>

#include "jobs/job/lifecycle.h"
#include "jobs/run/run_state_codec.h"
#include "wire/ledger_codec.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

// Values in one frame chunk, so that the frames of a large scenario fit into a message: 1 MiB.
constexpr std::ptrdiff_t kMaxChunkValues = std::ptrdiff_t{128} * 1024;
constexpr std::chrono::milliseconds kProgressTime{100};
// A larger checkpoint is not stored, because it would delay the commits of other jobs. Most of a
// checkpoint is samples of an unfinished chunk, so the next one may be smaller.
constexpr std::size_t kMaxCheckpointBytes = 4 << 20;

}  // namespace

v1::Event RunRecorder::Event() const { return EventAt(clock_.Now()); }

void RunRecorder::OnIteration(const Iteration& iteration) {
  v1::Event event = Event();
  *event.mutable_iteration() = Encode(scenario_, iteration);
  writer_.Add(std::move(event));
}

void RunRecorder::OnCycle(const Cycle& cycle) {
  v1::Event event = Event();
  *event.mutable_cycle() = Encode(scenario_, cycle);
  Keep(std::move(event));
}

void RunRecorder::OnGrowth(const Group& group) {
  v1::Event event = Event();
  *event.mutable_group_growth() = EncodeGrowth(scenario_, group);
  writer_.Add(std::move(event));
}

void RunRecorder::OnGroup(const Group& group) {
  v1::Event event = Event();
  *event.mutable_group() = Encode(scenario_, group);
  Keep(std::move(event));
}

void RunRecorder::Keep(v1::Event event) {
  if (event.has_frame_chunk()) passings_.See(event.frame_chunk());
  v1::Job row;
  if (event.has_cycle()) *row.add_cycles() = event.cycle();
  if (event.has_group()) *row.add_groups() = event.group();
  if (event.has_log_entry()) row.add_warnings(event.log_entry().message());
  const bool kept = event.has_cycle() || event.has_group() || event.has_log_entry();
  if (!writer_.Add(std::move(event)) || !kept) return;
  assignment_.record->Do([&](v1::Job& job) { job.MergeFrom(row); });
}

std::vector<v1::FrameChunk> ChunksOf(const Scenario& scenario, const Samples& samples) {
  const std::ptrdiff_t rows = std::max<std::ptrdiff_t>(1, kMaxChunkValues / samples.columns);
  std::vector<v1::FrameChunk> chunks;
  for (std::ptrdiff_t first = 0; first < samples.rows(); first += rows) {
    const auto begin = samples.values.begin() + first * samples.columns;
    const auto count = std::min<std::ptrdiff_t>(rows, samples.rows() - first) * samples.columns;
    chunks.push_back(
        Encode(scenario, Samples{samples.first + first, samples.columns, {begin, begin + count}}));
  }
  return chunks;
}

void RunRecorder::OnSamples(const Samples& samples) {
  for (v1::FrameChunk& chunk : ChunksOf(scenario_, samples)) {
    passings_.See(chunk);
    v1::Event event = Event();
    *event.mutable_frame_chunk() = std::move(chunk);
    writer_.Add(std::move(event));
  }
}

void RunRecorder::OnProgress(const Progress& progress) {
  const v1::Progress message = Encode(scenario_, progress);
  assignment_.record->Do([&](v1::Job& job) { *job.mutable_progress() = message; });
  writer_.WriteIfDue();
  const auto now = clock_.Elapsed();
  if (now - last_progress_ < kProgressTime) return;
  last_progress_ = now;
  v1::Event event = Event();
  *event.mutable_progress() = message;
  assignment_.log->SetProgress(std::move(event));
}

void RunRecorder::OnWarning(const std::string& warning) {
  v1::Event event = Event();
  event.mutable_log_entry()->set_severity(v1::LogEntry::WARNING);
  event.mutable_log_entry()->set_message(warning);
  Keep(std::move(event));
}

void RunRecorder::OnBoundary(const std::function<RunState()>& state) {
  const auto now = clock_.Elapsed();
  if (checkpoint_interval_.count() == 0 || now - last_checkpoint_ < checkpoint_interval_) return;
  last_checkpoint_ = now;
  std::string bytes = EncodeRunState(state());
  if (bytes.size() <= kMaxCheckpointBytes) writer_.AddCheckpoint(std::move(bytes));
}

}  // namespace contact
