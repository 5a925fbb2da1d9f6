#pragma once

#include <cstdint>
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

  void OnStep(const StepTime& step) override;

  /// True if samples are missing because the run was asked to stop.
  bool cut_short() const { return cut_short_; }

  /// Records the state at time 0 and later hands out what is left.
  void RecordStart(const State& state);
  void Flush();

  /// Samples that were not handed out yet, with the index of the first.
  Samples pending() const;
  /// Goes on after those.
  void Restore(Samples pending);

  /// Keeps the samples from now on until they are released or taken back.
  void Hold();
  void Release();
  void TakeBack();

 private:
  void Record(double time, const Eigen::ArrayXd& y);

  const Scenario& scenario_;
  Motion& motion_;
  Observer& observer_;
  const std::stop_token stop_;
  bool cut_short_ = false;
  std::int64_t next_ = 0;  // Index of the next sample.
  Samples samples_;
  bool holding_ = false;
  std::vector<Samples> held_;     // Full chunks.
  std::int64_t next_before_ = 0;  // What there was before Hold.
  Samples samples_before_;
  Eigen::ArrayXd y_, slope_;
};

}  // namespace contact
