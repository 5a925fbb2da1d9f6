#include "jobs/run_recorder.h"

#include <algorithm>
#include <cstddef>

#include "jobs/lifecycle.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

// Values in one frame chunk, so that the frames of a large scenario fit into a message: 1 MiB.
constexpr std::ptrdiff_t kMaxChunkValues = 128 * 1024;
constexpr std::chrono::milliseconds kProgressTime{100};
// Calls of OnSamples that a run makes before it looks whether it is to stop, unless its step is
// huge.
constexpr int kMostChunks = 8;

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
  v1::Cycle row = event.cycle();
  if (!writer_.Add(std::move(event))) return;
  record_.Do([&](v1::Job& job) { *job.add_cycles() = std::move(row); });
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
  if (control_.stopping() && ++chunks_ > kMostChunks) throw RunStopped();
  for (v1::FrameChunk& chunk : ChunksOf(scenario_, samples)) {
    v1::Event event = Event();
    *event.mutable_frame_chunk() = std::move(chunk);
    writer_.Add(std::move(event));
  }
}

void RunRecorder::OnProgress(const Progress& progress) {
  const v1::Progress message = Encode(scenario_, progress);
  record_.Do([&](v1::Job& job) { *job.mutable_progress() = message; });
  writer_.Pump();
  const auto now = std::chrono::steady_clock::now();
  if (now - last_progress_ < kProgressTime) return;
  last_progress_ = now;
  v1::Event event = Event();
  *event.mutable_progress() = message;
  log_.SetProgress(std::move(event));
}

void RunRecorder::OnWarning(const std::string& warning) {
  v1::Event event = Event();
  event.mutable_log_entry()->set_severity(v1::LogEntry::WARNING);
  event.mutable_log_entry()->set_message(warning);
  if (!writer_.Add(std::move(event))) return;
  record_.Do([&](v1::Job& job) { job.add_warnings(warning); });
}

void RunRecorder::OnStep() {
  chunks_ = 0;
  control_.CountStep();
}

}  // namespace contact
