#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// What turns within this part of its largest turn so far is still: a ball that rests on a floor
/// turns at 1e-12 by round-off, and a billionth is seen on no axis (Turns.WhatRestsHasNone).
inline constexpr double kStill = 1e-9;

/// The samples of a trajectory: when each is taken, and the chunks in which they go out.
class SampleLog {
 public:
  /// `hand_out` gets each chunk. The scenario must outlive the log. Once `stop` is requested no
  /// further chunk is begun, however many samples there are.
  SampleLog(const Scenario& scenario, std::stop_token stop,
            std::function<void(const Samples&)> hand_out);

  /// Takes the samples up to an instant [s] that are not taken yet, in the order of time: those at
  /// multiples of the interval, of the wanted ones those that are near no other, and of the turns
  /// the extremes between two of these, if it takes them to see the motion. `take(t, row)` appends
  /// the values of a sample, which follow its time. The last one is at the end of the run, though
  /// t, a multiple of the interval, may miss it by round-off. A chunk that `steps`, those of the
  /// run so far, have made due is handed out though it is not full.
  template <class Take>
  void TakeUntil(double instant, std::span<const CycleSample> wanted, std::span<const Turn> turns,
                 std::int64_t steps, Take take) {
    steps_ = steps;
    TakeAll(instant, wanted, turns, take);
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
  void TakeAll(double instant, std::span<const CycleSample> wanted, std::span<const Turn> turns,
               Take take) {
    while (true) {
      const double regular = NextRegular(instant);
      const CycleSample next = wanted.empty() ? CycleSample{.time = kNever} : wanted.front();
      for (const double sample = std::min(regular, next.time);
           !turns.empty() && turns.front().time < sample; turns = turns.subspan(1)) {
        Offer(turns.front(), take);
      }
      if (regular == kNever && next.time == kNever) return;
      const bool in_cycle = next.time < regular - next.near;
      if (in_cycle) wanted = wanted.subspan(1);
      if (in_cycle && (next.time - last_ <= next.near || full())) continue;
      TakeExtremes();
      const double time = in_cycle ? next.time : regular;
      if (!Begin(std::min(time, scenario_.end_time))) return;
      ++(in_cycle ? in_cycles_ : regular_);
      take(time, &samples_.values);
      End();
    }
  }
  /// Keeps the turn if its channel was neither as low nor as high since the last sample.
  template <class Take>
  void Offer(const Turn& turn, Take take) {
    if (turn.time <= last_) return;
    Extremes& channel = extremes_[static_cast<std::size_t>(turn.channel)];
    const bool is_first = channel.turns++ == 0;
    channel.scale = std::max(channel.scale, std::abs(turn.value));
    const double still = kStill * channel.scale;
    const bool is_low = is_first || turn.value < channel.low.turn.value - still;
    const bool is_high = is_first || turn.value > channel.high.turn.value + still;
    if (!is_low && !is_high) return;
    row_.clear();
    take(turn.time, &row_);
    if (is_low) channel.low = {turn, row_};
    if (is_high) channel.high = {turn, row_};
  }
  /// Takes the extremes since the last sample as samples, if some channel has turned twice.
  void TakeExtremes();
  /// Time of the next sample at the interval [s]; kNever if it comes after `instant`.
  double NextRegular(double instant) const;
  /// False if the run is stopped and no chunk may begin.
  bool Begin(double time);
  void End();

  const Scenario& scenario_;
  const std::stop_token stop_;
  const std::function<void(const Samples&)> hand_out_;
  bool cut_short_ = false;
  std::int64_t next_ = 0;       // Index of the next sample in the trajectory.
  std::int64_t regular_ = 0;    // Samples at multiples of the interval so far.
  std::int64_t in_cycles_ = 0;  // Samples because of cycles so far.
  double last_ = 0;             // Time of the last sample [s].
  std::int64_t steps_ = 0;      // Of the run so far.
  std::int64_t due_;  // The number of steps at which the chunk is handed out, full or not.
  Samples samples_;   // The chunk that is being filled.
  std::vector<Extremes> extremes_;  // Since the last sample.
  std::vector<double> row_;         // Scratch.
};

}  // namespace contact
