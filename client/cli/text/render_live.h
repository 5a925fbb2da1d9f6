#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/base/style.h"
#include "cli/link/watch.h"
#include "cli/text/progress_signals.h"

namespace contact::cli {

/// Shows a watch as it goes on: a growing table of the μ-iteration, remarks, and how far the job
/// is, as a line below that is drawn anew ten times a second or as a line for each tenth.
class LiveView : public WatchObserver {
 public:
  struct Options {
    bool cycles = true;       ///< Show ledger rows too.
    int most_iterations = 0;  ///< Rows of the iteration table; 0: all.
    std::string job;          ///< To say how to see the rest.
    ProgressForm progress = ProgressForm::kNone;
  };

  /// Events go to `rows`, the line of progress and troubles to `messages`, which may be the same.
  LiveView(std::FILE* rows, const Style& rows_style, std::FILE* messages,
           const Style& messages_style, Options options);
  ~LiveView() override;

  void OnSnapshot(const v1::Job& job) override;
  void OnEvent(const v1::Event& event) override;
  void OnLost(const std::string& why, std::chrono::milliseconds pause) override;
  void OnTick() override;

 private:
  void Write(std::FILE* stream, const std::string& line);
  void ShowIteration(const v1::Iteration& iteration);
  void ShowCycle(const v1::Cycle& cycle);
  void ShowState(const v1::StateChanged& change);
  void DrawProgress();
  void TellProgress(double elapsed_s);
  void EraseProgress();

  std::FILE* rows_;
  Style rows_style_;
  std::FILE* messages_;
  Style messages_style_;
  Options options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<v1::Progress> progress_;
  std::optional<ProgressSignals> signals_;  ///< With ProgressForm::kJson.
  std::int64_t iterations_ = 0;
  bool header_shown_ = false;
  bool drawn_ = false;
  int told_tenths_ = 0;
};

/// How far a run is and how long it may still take, in words.
std::string ProgressWords(const v1::Progress& progress, double elapsed_s);

/// The same after a bar, at most `width` characters (0: no limit).
std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width,
                           bool utf8 = true);

/// `, 3.2 s left`, if enough is done to tell.
std::string TimeLeft(double part_done, double elapsed_s);

}  // namespace contact::cli
