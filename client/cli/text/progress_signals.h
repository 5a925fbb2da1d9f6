#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The part of a run or sweep that is done, from 0 to 1.
double PartDone(const v1::Progress& progress);

/// How long it may still take, in seconds; none while too little is done to tell.
std::optional<double> TimeToGo(double part_done, double elapsed_s);

/// Tells programs how far a job is, as lines of JSON: at most ten a second, and always the last.
class ProgressSignals {
 public:
  using Clock = std::chrono::steady_clock;

  ProgressSignals(std::FILE* stream, std::string job);
  ~ProgressSignals();
  ProgressSignals(const ProgressSignals&) = delete;
  ProgressSignals& operator=(const ProgressSignals&) = delete;

  void Hear(const v1::Progress& progress, Clock::time_point now = Clock::now());

 private:
  void Tell(Clock::time_point now);

  std::FILE* const stream_;
  const std::string job_;
  const Clock::time_point start_ = Clock::now();
  std::optional<Clock::time_point> told_;
  std::optional<v1::Progress> last_;  // Heard.
  std::optional<v1::Progress> untold_;
};

/// One line of JSON: kind, job, done; of a run time_s, end_time_s, steps, cycles, iterations, of a
/// sweep cells, cells_done, cells_failed, cells_not_converged; eta_s, null if that cannot be told.
std::string ProgressJson(const v1::Progress& progress, const std::string& job, double elapsed_s);

}  // namespace contact::cli
