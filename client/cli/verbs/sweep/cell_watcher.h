#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"
#include "cli/text/render_progress.h"
#include "cli/text/sweep/sweep_cells.h"

namespace contact::cli {

/// Gathers the cells of a sweep from the events of a watch. Shows nothing.
class CellCollector : public WatchObserver {
 public:
  void OnEvent(const v1::Event& event) override;

  /// Gives the cells that came away; a cell that came twice is there once.
  SweepCells Take() { return std::move(cells_); }

 private:
  SweepCells cells_;
};

/// Gathers cells and shows on the standard error how far the sweep is. Not thread-safe.
class CellWatcher final : public CellCollector {
 public:
  /// `job` is the ID that lines of JSON name; `form` is how progress is shown.
  CellWatcher(const std::string& job, ProgressForm form);
  /// Erases the progress from the terminal.
  ~CellWatcher() override;

  /// Tells programs the progress of the job.
  void OnSnapshot(const v1::Job& job) override;
  void OnEvent(const v1::Event& event) override;
  void OnLost(const std::string& why) override;
  void OnRegained() override;

 private:
  /// Shows the progress in the form that was chosen; with kLines only once for each tenth.
  void Show(const v1::Progress& progress);
  /// Erases the line that stands on the terminal, if one does.
  void Erase();

  const ProgressForm form_;
  std::optional<JsonProgress> json_progress_;  // Set with ProgressForm::kJson.
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  int told_tenths_ = 0;  // The last tenth of the sweep that a line told.
  bool shown_ = false;   // True while a line of ProgressForm::kBar stands on the terminal.
};

/// Waits for the end of the sweep `job` and fetches its cells, without showing progress. Throws
/// CallFailure, and Failure (kTimeout, kInterrupted) when the wait ends first.
SweepCells ReadCells(Client& client, const v1::Job& job, const Settings& settings);

/// Gathers the cells of a sweep while it runs and shows how far it is. The watch ends with the
/// sweep, at the deadline of `settings`, or on Ctrl-C while the caller holds an Interrupt. `cells`
/// receives what came; `job` is replaced by the ended job if the sweep ended. Throws CallFailure.
WatchEnd GatherCells(Client& client, v1::Job* job, const Settings& settings, SweepCells* cells);

}  // namespace contact::cli
