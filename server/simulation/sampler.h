#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "simulation/model/observer.h"
#include "simulation/motion/motion.h"

namespace contact {

/// Samples the accepted trajectory at equal intervals, from the integrator's dense output.
class Sampler final : public StepListener {
 public:
  /// All outlive the sampler. Once `stop` is requested it hands out no further chunk of samples of
  /// a step, however many there are.
  Sampler(const Scenario& scenario, Motion& motion, Observer& observer, std::stop_token stop);

  /// Takes the samples that lie in an accepted step.
  void OnStep(const StepTime& step) override;

  /// True if samples are missing because the run was asked to stop.
  bool cut_short() const { return cut_short_; }

  /// Takes the first sample, of the state at time 0. Begins a recording of `motion`.
  void RecordStart(const State& state);
  /// Hands out what is left, at the end of the run.
  void Flush();

  /// Samples that were not handed out yet, with the index of the first.
  Samples pending() const;
  /// Goes on after those.
  void Restore(Samples pending);

  /// Keeps the samples from now on until they are released or taken back.
  void Hold();
  /// Hands out what was kept, if anything, and from now on at once again.
  void Release();
  /// Forgets what was kept: goes on from where Hold was called.
  void TakeBack();

 private:
  /// Takes a sample of the state y.
  void Record(double time, const Eigen::ArrayXd& y);

  const Scenario& scenario_;
  Motion& motion_;
  Observer& observer_;
  const std::stop_token stop_;
  bool cut_short_ = false;
  // Index of the next sample in the trajectory.
  std::int64_t next_ = 0;
  // The chunk that is being filled.
  Samples samples_;
  // What was pending at Hold, while samples are kept.
  std::optional<Samples> before_;
  // Full chunks that are kept.
  std::vector<Samples> held_;
  // Scratch: the state of a sample, and its slopes.
  Eigen::ArrayXd y_, slope_;
};

}  // namespace contact
