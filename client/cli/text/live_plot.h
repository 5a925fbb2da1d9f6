#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// Size of the part of a terminal that is drawn on.
struct PlotSize {
  int columns = 80;
  int rows = 24;
};

/// Lines that show channels over time up to `until` [s], below each other; at most `size.rows`.
/// Channels of which nothing has come yet have a title alone.
std::vector<std::string> RenderLivePlot(const std::vector<SampleColumn>& columns,
                                        const std::vector<std::string>& channels, double until,
                                        const PlotSize& size, bool braille);

/// Draws channels on a terminal, ten times a second, while they are computed or replayed.
class LivePlot : public Recorder {
 public:
  struct Options {
    std::vector<std::string> channels;
    double replay = 0;  ///< Simulated seconds in a second; 0: as they come.
    bool braille = true;
  };

  LivePlot(std::FILE* terminal, Options options);
  ~LivePlot() override;  ///< Leaves the last picture below what stood on the terminal.

  void OnEvent(const v1::Event& event) override;
  void OnTick() override;

  /// A channel that the job does not have, once that is known: what to say of it.
  const std::optional<std::string>& mistake() const { return mistake_; }
  /// True while a replay has not reached the last sample.
  bool replaying() const;

 private:
  double Until() const;
  std::vector<std::string> Picture() const;

  std::FILE* const terminal_;
  const Options options_;
  std::vector<SampleColumn> columns_;
  std::optional<std::string> mistake_;
  std::optional<std::chrono::steady_clock::time_point> start_;  ///< Of the replay.
  bool stale_ = true;                                           ///< Chunks came since columns_.
};

}  // namespace contact::cli
