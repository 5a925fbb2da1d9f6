#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The part of a run or sweep that is done, from 0 to 1; 0 while its length is unknown.
double PartDone(const v1::Progress& progress);

/// The time [s] that a job will still take at its speed so far; none while too little is done to
/// tell.
std::optional<double> TimeToGo(double part_done, double elapsed_s);

/// TimeToGo in words, such as `, 3.2 s left`; empty for none.
std::string TimeLeft(double part_done, double elapsed_s);

/// How far a run is, how long it will still take, and what keeps it busy, in words.
std::string ProgressWords(const v1::Progress& progress, double elapsed_s);

/// A bar with ProgressWords behind it, in at most `width` characters (0: no limit); the words alone
/// where both do not fit. Without `utf8` the bar is of ASCII characters.
std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width,
                           bool utf8 = true);

/// One line of JSON: kind, job, done; for a run time_s, end_time_s, steps, cycles, iterations,
/// busy_with, for a sweep cells, cells_done, cells_failed, cells_not_converged; eta_s, null while
/// it is unknown.
std::string ProgressJson(const v1::Progress& progress, const std::string& job, double elapsed_s);

/// Writes how far a job is for programs, an object of JSON a line: at most ten lines a second, and
/// always the last progress. Not thread-safe.
class JsonProgress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `stream` must outlive this object; `job` is written into each line. The elapsed time of the
  /// lines starts here.
  JsonProgress(std::FILE* stream, std::string job);
  /// Writes the last progress if no line has told it.
  ~JsonProgress();
  JsonProgress(const JsonProgress&) = delete;
  JsonProgress& operator=(const JsonProgress&) = delete;

  /// Takes the newest progress. Writes a line unless it is the same as before, the last line is
  /// less than a tenth of a second old, or nothing is known of the job's length yet.
  void Update(const v1::Progress& progress, Clock::time_point now = Clock::now());

 private:
  /// Writes the pending progress.
  void Write(Clock::time_point now);

  std::FILE* const stream_;
  const std::string job_;
  const Clock::time_point start_ = Clock::now();
  std::optional<Clock::time_point> written_;  // When the last line was written.
  std::optional<v1::Progress> last_;          // The newest progress.
  std::optional<v1::Progress> pending_;       // The newest progress while no line has told it.
};

}  // namespace contact::cli
