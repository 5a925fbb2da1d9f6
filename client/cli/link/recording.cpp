#include "cli/link/recording.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cli/base/interrupt.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"
#include "wire/column_bytes.h"

namespace contact::cli {
namespace {

void Replay(Client& client, const std::string& name, const Settings& settings, bool trajectory,
            Recorder* recorder) {
  WatchOptions options{.name = name,
                       .kinds = {"attempt_started", "iteration", "cycle", "group"},
                       .overflow = v1::DeliveryOptions::LAG};
  if (trajectory) options.kinds.emplace_back("frame_chunk");
  WatchToEnd(client, std::move(options), settings, *recorder);
}

// Puts all entries into the list if it lacks some.
template <class Entry>
void Complete(const std::vector<Entry>& all, google::protobuf::RepeatedPtrField<Entry>* list) {
  if (static_cast<std::size_t>(list->size()) < all.size()) list->Assign(all.begin(), all.end());
}

// In the order of their keys.
template <class Key, class Value>
std::vector<Value> ValuesOf(const std::map<Key, Value>& map) {
  std::vector<Value> values;
  values.reserve(map.size());
  for (const auto& [key, value] : map) values.push_back(value);
  return values;
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
    cycles_.clear();
    groups_.clear();
  } else if (event.has_iteration()) {
    const v1::Iteration& iteration = event.iteration();
    iterations_[{iteration.episode(), iteration.number()}] = iteration;
  } else if (event.has_cycle()) {
    cycles_[event.sequence()] = event.cycle();
  } else if (event.has_group()) {
    groups_[event.sequence()] = event.group();
  } else if (event.has_frame_chunk()) {
    chunks_[{event.frame_chunk().first_sample(), event.sequence()}] = event.frame_chunk();
  }
}

bool Recorder::has_holes() const {
  std::int64_t following = 0;
  std::uint64_t columns = 0;  // Sequence of the event that has the next ones; 0: any.
  for (const auto& [place, chunk] : chunks_) {
    if (place.first != following || (columns != 0 && place.second != columns)) return true;
    columns = chunk.columns_follow() ? place.second + 1 : 0;
    if (columns == 0) following += chunk.samples();
  }
  return false;
}

std::vector<SampleColumn> Recorder::Columns() const {
  std::vector<SampleColumn> columns;
  std::size_t next = 0;  // Column of a chunk whose columns are split.
  for (const auto& [place, chunk] : chunks_) {
    for (int i = next > 0 ? 1 : 0; i < chunk.columns_size(); ++i, ++next) {
      const v1::FrameChunk::Column& column = chunk.columns(i);
      if (next == columns.size()) {
        columns.push_back({column.name(), column.quantity(), column.unit(), {}});
      }
      AppendDoubles(column.values(), &columns[next].values);
    }
    if (!chunk.columns_follow()) next = 0;
  }
  // The last columns of the last samples may not have come.
  for (SampleColumn& column : columns) column.values.resize(columns.back().values.size());
  return columns;
}

std::vector<v1::Iteration> Recorder::Iterations() const { return ValuesOf(iterations_); }

std::vector<v1::Cycle> Recorder::Cycles() const { return ValuesOf(cycles_); }

std::vector<v1::Group> Recorder::Groups() const { return ValuesOf(groups_); }

Recording ReadRecording(Client& client, const std::string& job, const Settings& settings,
                        bool trajectory) {
  const Interrupt interrupt;
  Recorder recorder;
  ReplayWhole(job, [&] {
    Replay(client, JobName(job), settings, trajectory, &recorder);
    return !recorder.has_holes();
  });
  Recording recording{.job = GetJob(client, job),
                      .columns = recorder.Columns(),
                      .iterations = recorder.Iterations()};
  // GetJob leaves out the end of long lists; the events have all of them.
  Complete(recorder.Cycles(), recording.job.mutable_cycles());
  Complete(recorder.Groups(), recording.job.mutable_groups());
  return recording;
}

}  // namespace contact::cli
