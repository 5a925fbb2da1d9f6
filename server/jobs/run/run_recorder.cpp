#include "jobs/run/run_recorder.h"

#include <cstddef>

#include "jobs/job/lifecycle.h"
#include "jobs/run/run_state_codec.h"
#include "wire/ledger_codec.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

constexpr std::chrono::milliseconds kProgressTime{100};
// What a row of the ledger takes in memory beside its content.
constexpr std::size_t kRowBytes = 400;
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
  if (event.has_frame_chunk()) {
    if (const auto* whole = joiner_.Add(event.frame_chunk())) passings_.See(*whole);
  }
  v1::Job row;
  if (event.has_cycle()) *row.add_cycles() = event.cycle();
  if (event.has_group()) *row.add_groups() = event.group();
  if (event.has_log_entry()) row.add_warnings(event.log_entry().message());
  const bool kept = event.has_cycle() || event.has_group() || event.has_log_entry();
  if (!writer_.Add(std::move(event)) || !kept) return;
  assignment_.control->CountLedger(static_cast<std::int64_t>(row.ByteSizeLong() + kRowBytes));
  assignment_.record->Do([&](v1::Job& job) { job.MergeFrom(row); });
}

void RunRecorder::OnSamples(const Samples& samples) {
  v1::FrameChunk chunk = Encode(scenario_, samples);
  passings_.See(chunk);
  for (v1::FrameChunk& part : SplitColumns(std::move(chunk))) {
    v1::Event event = Event();
    *event.mutable_frame_chunk() = std::move(part);
    // Readers leave out samples without all columns.
    if (!writer_.Add(std::move(event)) || assignment_.control->stopping()) return;
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

void RunRecorder::OnStep() {
  assignment_.control->CountStep();
  if (!assignment_.control->yielding()) return;
  writer_.WriteIfDue();
  assignment_.yield();
}

void RunRecorder::OnBoundary(const std::function<RunState()>& state) {
  const auto now = clock_.Elapsed();
  if (checkpoint_interval_.count() == 0 || now - last_checkpoint_ < checkpoint_interval_) return;
  last_checkpoint_ = now;
  std::string bytes = EncodeRunState(state());
  if (bytes.size() <= kMaxCheckpointBytes) writer_.AddCheckpoint(std::move(bytes));
}

}  // namespace contact
