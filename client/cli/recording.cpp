#include "cli/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#include "cli/follow.h"
#include "cli/interrupt.h"

namespace contact::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "columns are little-endian");

void Append(const std::string& bytes, std::vector<double>* values) {
  const std::size_t count = bytes.size() / sizeof(double);
  values->resize(values->size() + count);
  std::memcpy(values->data() + values->size() - count, bytes.data(), count * sizeof(double));
}

void Replay(Client& client, const std::string& name, const Settings& settings, Recorder* recorder) {
  WatchOptions options;
  options.name = name;
  options.kinds = {"attempt_started", "iteration", "frame_chunk"};
  options.overflow = v1::DeliveryOptions::LAG;
  options.deadline = settings.Deadline();
  options.stopped = Interrupt::raised;
  const WatchEnd end = Watch(client, options, *recorder);
  if (end == WatchEnd::kFinished) return;
  const bool interrupted = end == WatchEnd::kStopped;
  throw Failure(interrupted ? ExitCode::kInterrupted : ExitCode::kTimeout,
                fmt::format("{}; {} has not ended, or is long",
                            interrupted ? "interrupted" : "time is up", name));
}

}  // namespace

const SampleColumn* Recording::Find(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, &SampleColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

void Recorder::OnEvent(const v1::Event& event) {
  if (event.has_attempt_started()) {  // What came before is of an earlier attempt.
    chunks_.clear();
    iterations_.clear();
  } else if (event.has_iteration()) {
    const v1::Iteration& iteration = event.iteration();
    iterations_[{iteration.episode(), iteration.number()}] = iteration;
  } else if (event.has_frame_chunk()) {
    chunks_[event.frame_chunk().first_sample()] = event.frame_chunk();
  }
}

bool Recorder::has_holes() const {
  std::int64_t following = 0;
  for (const auto& [first, chunk] : chunks_) {
    if (first != following) return true;
    following += chunk.samples();
  }
  return false;
}

std::vector<SampleColumn> Recorder::Columns() const {
  std::vector<SampleColumn> columns;
  for (const auto& [first, chunk] : chunks_) {
    columns.resize(static_cast<std::size_t>(chunk.columns_size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const v1::FrameChunk::Column& column = chunk.columns(static_cast<int>(i));
      if (first == 0) columns[i] = {column.name(), column.quantity(), column.unit(), {}};
      Append(column.values(), &columns[i].values);
    }
  }
  return columns;
}

std::vector<v1::Iteration> Recorder::Iterations() const {
  std::vector<v1::Iteration> all;
  all.reserve(iterations_.size());
  for (const auto& [key, iteration] : iterations_) all.push_back(iteration);
  return all;
}

Recording ReadRecording(Client& client, const std::string& job, const Settings& settings) {
  const Interrupt interrupt;
  Recorder recorder;
  Replay(client, JobName(job), settings, &recorder);
  if (recorder.has_holes()) Replay(client, JobName(job), settings, &recorder);
  if (recorder.has_holes()) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("parts of the trajectory of {} do not come; try again", job));
  }
  v1::GetJobRequest request;
  request.set_name(JobName(job));
  return {
      .job = client.Call(&Client::Stub::GetJob, request),
      .revision = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest()).revision(),
      .columns = recorder.Columns(),
      .iterations = recorder.Iterations()};
}

}  // namespace contact::cli
