#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/base/style.h"
#include "cli/link/watch.h"
#include "cli/text/json_progress.h"

namespace contact::cli {

/// Shows a watch on a terminal while it goes on: a growing table of the μ-iteration, the cycles,
/// warnings, and how far the job is. Not thread-safe.
class LiveView : public WatchObserver {
 public:
  struct Options {
    bool cycles = true;       ///< Show state changes and the cycles of the ledger, too.
    int most_iterations = 0;  ///< Rows of the table of the μ-iteration; 0: all.
    std::string job;          ///< For the command that shows the rest, and for JSON.
    ProgressForm progress = ProgressForm::kNone;
  };

  /// Events go to `rows`, progress and lost connections to `messages`. Both may be the same stream
  /// and must outlive this object.
  LiveView(std::FILE* rows, const Style& rows_style, std::FILE* messages,
           const Style& messages_style, Options options);
  /// Erases the progress bar.
  ~LiveView() override;

  void OnSnapshot(const v1::Job& job) override;
  void OnEvent(const v1::Event& event) override;
  void OnLost(const std::string& why, std::chrono::milliseconds pause) override;
  /// Draws the bar again or writes the line of progress, if either is wanted; not in the first
  /// 0.2 s.
  void OnTick() override;

 private:
  // Writes a line in the place of the progress bar.
  void Write(std::FILE* stream, const std::string& line);
  void ShowIteration(const v1::Iteration& iteration);
  void ShowCycle(const v1::Cycle& cycle);
  void ShowState(const v1::StateChanged& change);
  void ShowLogEntry(const v1::LogEntry& entry);
  // Shows the start of an attempt that is not the first.
  void ShowAttempt(const v1::AttemptStarted& start);
  // Writes a line for each tenth of the job that is done.
  void WriteProgressLine(double elapsed_s);
  void EraseProgress();

  std::FILE* rows_;
  Style rows_style_;
  std::FILE* messages_;
  Style messages_style_;
  Options options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<v1::Progress> progress_;
  std::optional<JsonProgress> json_;  // Set with ProgressForm::kJson.
  std::int64_t iterations_ = 0;       // Rows that came, shown or not.
  bool header_shown_ = false;
  bool drawn_ = false;  // True while the bar stands on the terminal.
  int written_tenths_ = 0;
};

}  // namespace contact::cli
