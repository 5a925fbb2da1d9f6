#pragma once

#include <stop_token>
#include <vector>

#include "simulation/clusters/world.h"
#include "simulation/episode/run_state.h"
#include "simulation/model/observer.h"
#include "simulation/motion/equations.h"

namespace contact {

/// Samples of a world, at equal intervals and where its cycles want them; as Sampler makes them.
class Frames {
 public:
  /// All outlive the frames. Once `stop` is requested they hand out no further chunk of samples,
  /// however many there are.
  Frames(const World& world, Observer& observer, std::stop_token stop);

  /// Takes the samples up to an instant that are not taken yet [s]. `pieces`: all that go on after
  /// the last sample.
  void RecordUntil(double instant, const Pieces& pieces);
  /// Hands out what is left, at the end of the run.
  void Flush();
  /// True if samples are missing because the run was asked to stop.
  bool cut_short() const { return cut_short_; }
  /// True if cycles have had all samples that Scenario::most_contact_samples allows, if any.
  bool full() const;

  Sampling Save() const;
  /// All up to `time` was taken [s].
  void Restore(Sampling from, double time);

 private:
  void FindSamples(double from, double until, const Pieces& pieces);
  void Record(double instant, const Pieces& pieces);
  void FindForces(double instant, const Pieces& pieces);

  const World& world_;
  const Scenario& scenario_;
  Observer& observer_;
  const std::stop_token stop_;
  bool cut_short_ = false;
  const Equations equations_;
  std::int64_t next_ = 0, regular_ = 0;  // Samples so far, and those at the interval.
  double last_ = -kNever;                // Time of the last sample [s].
  double until_ = 0;                     // All up to here are taken [s].
  Samples samples_;
  // Scratch: samples of cycles; u, v and a of each body; F of each contact.
  std::vector<CycleSample> wanted_;
  std::vector<double> u_, v_, a_, force_;
};

}  // namespace contact
