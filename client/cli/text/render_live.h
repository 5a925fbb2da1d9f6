#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/base/style.h"
#include "cli/link/watch.h"
#include "cli/text/render_progress.h"
#include "contact/v1/event.pb.h"

namespace contact::cli {

/// Shows a watch on a terminal while it goes on: a growing table of the μ-iteration, the cycles,
/// warnings, and how far the job is. Not thread-safe.
class LiveView : public WatchObserver {
 public:
  /// Where and how to write. Both streams may be the same; they must outlive the view.
  struct Options {
    /// Receives events: rows of the iteration, cycles, states, warnings.
    std::FILE* rows = stdout;
    /// How to write to `rows`.
    Style rows_style = {};
    /// Receives progress and lost connections.
    std::FILE* messages = stderr;
    /// How to write to `messages`.
    Style messages_style = {};
    /// Show state changes and the cycles of the ledger, too.
    bool cycles = true;
    /// Rows of the table of the μ-iteration that are shown; 0: all.
    int most_iterations = 0;
    /// ID of the job, for the command that shows the rest, and for JSON.
    std::string job = {};
    /// How progress is shown.
    ProgressForm progress = ProgressForm::kNone;
  };

  explicit LiveView(Options options);
  /// Erases the progress bar.
  ~LiveView() override;

  /// Takes the progress of the job.
  void OnSnapshot(const v1::Job& job) override;
  /// Shows an event; frames and kinds that are unknown here are left out.
  void OnEvent(const v1::Event& event) override;
  /// Says that the connection was lost, or is there again.
  void OnLost(const std::string& why) override;
  void OnRegained() override;
  /// Draws the bar again or writes the line of progress, if either is wanted; not in the first
  /// 0.2 s.
  void OnTick() override;

 private:
  /// Writes a line in the place of the progress bar.
  void Write(std::FILE* stream, const std::string& line);
  /// True once more rows of the iteration have come than are to be shown.
  bool TooMany() const {
    return options_.most_iterations > 0 && iterations_ > options_.most_iterations;
  }
  /// Shows a row for each unknown, up to the limit of rows.
  void ShowIteration(const v1::Iteration& iteration);
  /// Shows a growth in one line, unless iterations are not shown any more.
  void ShowGrowth(const v1::GroupGrowth& growth);
  /// Shows a cycle in one line, if cycles are wanted.
  void ShowCycle(const v1::Cycle& cycle);
  /// Shows a group in one line, if cycles are wanted and do not tell all of it.
  void ShowGroup(const v1::Group& group);
  /// Shows a change of state, if cycles are wanted; else the result that follows shows it.
  void ShowState(const v1::StateChanged& change);
  /// Shows a warning or a note.
  void ShowLogEntry(const v1::LogEntry& entry);
  /// Shows the start of an attempt that is not the first.
  void ShowAttempt(const v1::AttemptStarted& start);
  /// Writes a line for each tenth of the job that is done.
  void WriteProgressLine(double elapsed_s);
  /// Erases the bar if it stands on the terminal.
  void EraseProgress();

  Options options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<v1::Progress> progress_;
  std::optional<JsonProgress> json_;  // Set with ProgressForm::kJson.
  std::int64_t iterations_ = 0;       // Rows that came, shown or not.
  bool header_shown_ = false;
  bool drawn_ = false;  // True while the bar stands on the terminal.
  int written_tenths_ = 0;
};

/// The header of the table of the μ-iteration. Wide tables, and terminals of 120 columns or more,
/// have the bracket of μ, too. Terminals of less than 80 have no episode and next step; those of
/// less than 60 no ε either, and μ in six digits, so that a row fits into 40.
std::string IterationHeader(const Style& style);

/// The row of one unknown in one pass of an iteration, below IterationHeader.
std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style);

}  // namespace contact::cli
