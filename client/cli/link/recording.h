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
  std::string name;            ///< Such as `B1.velocity`, or `time`.
  std::string quantity;        ///< Such as `velocity`; see FrameChunk.Column.
  std::string unit;            ///< SI, such as `m/s`.
  std::vector<double> values;  ///< One a sample; as many in all columns of a recording.
};

/// What the last attempt of an ended job recorded.
struct Recording {
  v1::Job job;                            ///< As GetJob returns it, with the whole ledger.
  std::vector<SampleColumn> columns;      ///< `time` first. Empty if no trajectory was recorded.
  std::vector<v1::Iteration> iterations;  ///< In order of episode and pass.

  /// The column with this name; null if there is none.
  const SampleColumn* Find(const std::string& name) const;
};

/// Gathers a recording from the events of a watch. An event heard twice changes nothing.
class Recorder : public WatchObserver {
 public:
  /// Takes chunks, iterations and cycles; a new attempt drops what came before.
  void OnEvent(const v1::Event& event) override;

  /// True if chunks are missing between those that came: a slow watcher is spared some.
  bool has_holes() const;

  std::vector<SampleColumn> Columns() const;      ///< Of all chunks that came, joined.
  std::vector<v1::Iteration> Iterations() const;  ///< In order of episode and pass.
  std::vector<v1::Cycle> Cycles() const;          ///< In order of their events.

 private:
  std::map<std::int64_t, v1::FrameChunk> chunks_;            // By first sample.
  std::map<std::pair<int, int>, v1::Iteration> iterations_;  // By episode and pass.
  std::map<std::uint64_t, v1::Cycle> cycles_;                // By sequence.
};

/// Waits for the end of a job and fetches all that it recorded; without `trajectory` the recording
/// has no columns. `job` is an ID or jobs/ID. Throws CallFailure, and Failure: kTimeout or
/// kInterrupted if the wait ends first, kRunFailed if chunks are missing.
Recording ReadRecording(Client& client, const std::string& job, const Settings& settings,
                        bool trajectory = true);

}  // namespace contact::cli
