#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// Size in characters of the part of a terminal that is drawn on.
struct PlotSize {
  /// Characters in a line.
  int columns = 80;
  /// Lines.
  int rows = 24;
};

/// The lines of a plot of channels over time, below each other: at most `size.rows`, each at most
/// `size.columns` wide. `until` [s] is the end of what is shown; the axes are those of all samples.
/// A channel without samples has a title alone. With `braille` a character has 2 by 4 dots.
std::vector<std::string> RenderLivePlot(const std::vector<SampleColumn>& columns,
                                        const std::vector<std::string>& channels, double until,
                                        const PlotSize& size, bool braille);

/// Draws channels on a terminal while they are computed or replayed. The caller sets the pace by
/// OnTick. Not thread-safe.
class LivePlot : public Recorder {
 public:
  /// What is drawn, and how.
  struct Options {
    /// Channels such as `B1.velocity`; at least one.
    std::vector<std::string> channels;
    /// Speed of the replay in simulated seconds a second; 0: samples are shown as they come.
    double replay = 0;
    /// Draw with Braille dots, else with `*`.
    bool braille = true;
  };

  /// Switches `terminal`, which must outlive this object, to its second screen.
  LivePlot(std::FILE* terminal, Options options);
  /// Switches back and leaves the last plot below what stood on the terminal.
  ~LivePlot() override;

  /// Takes samples; a chunk without one of the channels sets mistake().
  void OnEvent(const v1::Event& event) override;
  /// Draws the plot again.
  void OnTick() override;

  /// What to tell of a channel that the job does not have; none until that is known.
  const std::optional<std::string>& mistake() const { return mistake_; }
  /// True while a replay has not reached the last sample.
  bool replaying() const;

 private:
  /// The end of what is shown now [s]; infinite without a replay.
  double Until() const;
  /// The lines of the plot as they are now.
  std::vector<std::string> Plot() const;
  /// Writes to the terminal at once; never throws for a terminal that is gone.
  void Write(const std::string& text);

  std::FILE* const terminal_;
  const Options options_;
  std::vector<SampleColumn> columns_;
  std::vector<std::string> names_;  // Of the columns so far of a chunk whose columns follow.
  std::optional<std::string> mistake_;
  std::optional<std::chrono::steady_clock::time_point> start_;  // When the replay began.
  bool stale_ = true;  // True if samples have come that columns_ lacks.
};

}  // namespace contact::cli
