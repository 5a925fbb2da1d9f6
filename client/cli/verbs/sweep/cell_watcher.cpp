#include "cli/verbs/sweep/cell_watcher.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "base/spelling.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/style.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"
#include "cli/text/render_progress.h"
#include "cli/verbs/job/follow.h"

namespace contact::cli {

void CellCollector::OnEvent(const v1::Event& event) {
  if (event.has_sweep_cell()) cells_[event.sweep_cell().index()] = event.sweep_cell();
}

CellWatcher::CellWatcher(const std::string& job, ProgressForm form) : form_(form) {
  if (form_ == ProgressForm::kJson) json_progress_.emplace(stderr, job);
}

CellWatcher::~CellWatcher() { Erase(); }

void CellWatcher::OnSnapshot(const v1::Job& job) {
  if (job.has_progress() && json_progress_) json_progress_->Update(job.progress());
}

void CellWatcher::OnEvent(const v1::Event& event) {
  CellCollector::OnEvent(event);
  if (event.has_progress()) Show(event.progress());
}

void CellWatcher::OnLost(const std::string& why) {
  Erase();
  TellLost(why);
}

void CellWatcher::OnRegained() {
  Erase();
  TellRegained();
}

void CellWatcher::Show(const v1::Progress& progress) {
  if (json_progress_) json_progress_->Update(progress);
  const double done = PartDone(progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const std::string words =
      fmt::format("{} of {}, {} failed, {} not converged{}", progress.cells_done(),
                  Count(progress.cells(), "cell", "cells"), progress.cells_failed(),
                  progress.cells_not_converged(), TimeLeft(done, elapsed.count()));
  const int tenths = static_cast<int>(10 * done);
  if (form_ == ProgressForm::kLines && tenths > std::exchange(told_tenths_, tenths)) {
    Tell("{}\n", words);
  }
  if (form_ != ProgressForm::kBar) return;
  const int width = StyleOf(fileno(stderr), "never").width;  // It may have been resized.
  fmt::print(stderr, "\r\x1b[K{}", width > 1 ? Cut(words, width - 1) : words);
  std::fflush(stderr);
  shown_ = true;
}

void CellWatcher::Erase() {
  if (std::exchange(shown_, false)) fmt::print(stderr, "\r\x1b[K");
}

SweepCells ReadCells(Client& client, const v1::Job& job, const Settings& settings) {
  const Interrupt interrupt;
  CellCollector collector;
  WatchToEnd(client, {.name = job.name(), .kinds = {"sweep_cell"}}, settings, collector);
  return collector.Take();
}

WatchEnd GatherCells(Client& client, v1::Job* job, const Settings& settings, SweepCells* cells) {
  CellWatcher watcher(ShortName(job->name()), settings.Progress());
  const WatchEnd end = WatchJob(client, job->name(), {"sweep_cell", "progress"}, settings, watcher);
  if (end == WatchEnd::kFinished) {
    *job = GetJob(client, job->name());
    watcher.OnSnapshot(*job);  // Programs always receive the last progress.
  }
  *cells = watcher.Take();
  return end;
}

}  // namespace contact::cli
