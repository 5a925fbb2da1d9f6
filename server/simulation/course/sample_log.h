#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "simulation/course/cycle_samples.h"
#include "simulation/episode/run_state.h"
#include "simulation/model/ledger.h"
#include "simulation/model/observer.h"
#include "simulation/model/scenario.h"

namespace contact {

/// What a run says whose cycles have had all samples that are allowed.
inline constexpr char kSamplesAreFull[] =
    "output.samples_per_contact: the trajectory has as many samples as the server allows; contacts "
    "after that have only those of sample_interval_s";

/// The samples of a trajectory: when each is taken, and the chunks in which they go out.
class SampleLog {
 public:
  /// `hand_out` gets each chunk. The scenario must outlive the log. Once `stop` is requested no
  /// further chunk is begun, however many samples there are.
  SampleLog(const Scenario& scenario, std::stop_token stop,
            std::function<void(const Samples&)> hand_out);

  /// Takes the samples up to an instant [s] that are not taken yet, in the order of time: those at
  /// multiples of the interval, and of the wanted ones those that are near no other. `take(t, row)`
  /// appends the values of a sample, which follow its time. The last one is at the end of the run,
  /// though t, a multiple of the interval, may miss it by round-off. A chunk that `steps`, those of
  /// the run so far, have made due is handed out though it is not full.
  template <class Take>
  void TakeUntil(double instant, std::span<const CycleSample> wanted, std::int64_t steps,
                 Take take) {
    steps_ = steps;
    TakeAll(instant, wanted, take);
    if (steps >= due_) Flush();
  }
  /// Hands out what is left, at the end of the run.
  void Flush();

  /// Ends the trajectory with the last chunk that was handed out, because the run is stopped.
  void CutShort();
  bool cut_short() const { return cut_short_; }
  /// True if cycles have had all samples that Scenario::most_contact_samples allows, if any.
  bool full() const;
  /// True if samples are missing because of that which somebody asked for.
  bool misses_samples() const { return full() && scenario_.wants_all_contact_samples; }

  /// Samples that were not handed out yet, and what else it takes to go on after them.
  Sampling Save() const;
  /// Goes on after those.
  void Restore(Sampling from);

 private:
  template <class Take>
  void TakeAll(double instant, std::span<const CycleSample> wanted, Take take) {
    while (true) {
      const double regular = NextRegular(instant);
      const CycleSample next = wanted.empty() ? CycleSample{.time = kNever} : wanted.front();
      if (regular == kNever && next.time == kNever) return;
      const bool in_cycle = next.time < regular - next.near;
      if (in_cycle) wanted = wanted.subspan(1);
      if (in_cycle && (next.time - last_ <= next.near || full())) continue;
      if (samples_.rows() == 0 && stop_.stop_requested()) CutShort();
      if (cut_short_) return;
      if (!in_cycle) ++regular_;
      const double time = in_cycle ? next.time : regular;
      Begin(std::min(time, scenario_.end_time));
      take(time, &samples_.values);
      End();
    }
  }
  /// Time of the next sample at the interval [s]; kNever if it comes after `instant`.
  double NextRegular(double instant) const;
  void Begin(double time);
  void End();

  const Scenario& scenario_;
  const std::stop_token stop_;
  const std::function<void(const Samples&)> hand_out_;
  bool cut_short_ = false;
  std::int64_t next_ = 0;     // Index of the next sample in the trajectory.
  std::int64_t regular_ = 0;  // Samples at multiples of the interval so far.
  double last_ = 0;           // Time of the last sample [s].
  std::int64_t steps_ = 0;    // Of the run so far.
  std::int64_t due_;          // The number of steps at which the chunk is handed out, full or not.
  Samples samples_;           // The chunk that is being filled.
};

}  // namespace contact
