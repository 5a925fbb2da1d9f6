#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// One quantity of the trajectory, at all samples.
struct SampleColumn {
  /// Such as `B1.velocity`, or `time`.
  std::string name;
  /// Such as `velocity`; see FrameChunk.Column.
  std::string quantity;
  /// SI, such as `m/s`.
  std::string unit;
  /// One value a sample. All columns of a recording have as many.
  std::vector<double> values;
};

/// What the last attempt of an ended job recorded.
struct Recording {
  /// As GetJob returns it, with the whole ledger and all groups.
  v1::Job job;
  /// `time` comes first. Empty if no trajectory was recorded.
  std::vector<SampleColumn> columns;
  /// In order of episode and pass.
  std::vector<v1::Iteration> iterations;

  /// The column with this name; null if there is none.
  const SampleColumn* Find(const std::string& name) const;
};

/// Gathers a recording from the events of a watch. An event heard twice changes nothing.
class Recorder : public WatchObserver {
 public:
  /// Takes chunks, iterations, cycles and groups; a new attempt drops what came before.
  void OnEvent(const v1::Event& event) override;

  /// True if chunks are missing between those that came: a slow watcher is spared some.
  bool has_holes() const;

  /// The columns of all chunks that came, joined.
  std::vector<SampleColumn> Columns() const;
  /// The iterations in order of episode and pass.
  std::vector<v1::Iteration> Iterations() const;
  /// The cycles in order of their events.
  std::vector<v1::Cycle> Cycles() const;
  /// The groups in order of their events.
  std::vector<v1::Group> Groups() const;

 private:
  /// By the number of the first sample and the sequence number of the event: columns may be split.
  std::map<std::pair<std::int64_t, std::uint64_t>, v1::FrameChunk> chunks_;
  /// By episode and pass.
  std::map<std::pair<int, int>, v1::Iteration> iterations_;
  /// By the sequence number of the event.
  std::map<std::uint64_t, v1::Cycle> cycles_;
  std::map<std::uint64_t, v1::Group> groups_;
};

/// Waits for the end of a job and fetches all that it recorded; without `trajectory` the recording
/// has no columns. `job` is an ID or jobs/ID. Throws CallFailure, and Failure: kTimeout or
/// kInterrupted if the wait ends first, kRunFailed if chunks are missing.
Recording ReadRecording(Client& client, const std::string& job, const Settings& settings,
                        bool trajectory = true);

}  // namespace contact::cli
