#pragma once

#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "simulation/course/course.h"
#include "simulation/course/sample_log.h"
#include "simulation/course/turns.h"
#include "simulation/episode/run_state.h"
#include "simulation/model/observer.h"
#include "simulation/motion/motion.h"

namespace contact {

/// Samples the accepted trajectory from the integrator's dense output: at equal intervals, and in
/// each running cycle at equal steps of its own.
///
/// Samples go out in the order of time, before it is known how long a cycle will last, and a run
/// may be cut within a cycle. So those of a cycle are placed from its start on by the duration that
/// it is expected to have, over Scenario::samples_per_contact.
class Sampler final : public Recording {
 public:
  /// All outlive the sampler. Once `stop` is requested it hands out no further chunk of samples of
  /// a step, however many there are.
  Sampler(const Scenario& scenario, Motion& motion, Observer& observer, std::stop_token stop);

  /// Takes the samples that lie in an accepted step.
  void OnStep(const StepTime& step) override;

  /// True if samples are missing because the run was asked to stop.
  bool cut_short() const { return log_.cut_short(); }
  /// See SampleLog.
  bool misses_samples() const { return log_.misses_samples(); }

  /// Takes the first sample, of the state at time 0. Begins a recording of `motion`.
  void RecordStart(const State& state);
  /// Hands out what is left, at the end of the run.
  void Flush() { log_.Flush(); }

  Sampling Save() const { return log_.Save(); }
  void Restore(Sampling from) { log_.Restore(std::move(from)); }

  /// Keeps the samples from now on until they are released or taken back.
  void Hold() override;
  /// Hands out what was kept, if anything, and from now on at once again. Once `stop` is requested
  /// the samples end with the last chunk that was handed out before.
  void Release() override;
  /// Forgets what was kept: goes on from where Hold was called.
  void TakeBack() override;

 private:
  /// Appends the values of a sample of the state y to a row.
  void Append(double time, const Eigen::ArrayXd& y, std::vector<double>* row);
  /// Appends those of the contacts, with the accelerations in slope_.
  void AppendContacts(const Eigen::ArrayXd& y, std::vector<double>* row) const;
  /// Appends those of the supports. The energy of all of them [J].
  double AppendSupports(const Eigen::ArrayXd& y, std::vector<double>* row) const;
  /// Passes a chunk on, or keeps it.
  void HandOut(const Samples& samples);

  const Scenario& scenario_;
  Motion& motion_;
  Observer& observer_;
  const std::stop_token stop_;
  SampleLog log_;
  // What was pending at Hold, while samples are kept.
  std::optional<Sampling> before_;
  // Full chunks that are kept.
  std::vector<Samples> held_;
  // Those of all bodies and contacts.
  const std::vector<int> bodies_, contacts_;
  TurnFinder turn_finder_;
  // Samples of cycles in the step, and turns.
  std::vector<CycleSample> planned_;
  std::vector<Turn> turns_;
  // Scratch: the state of a sample, and its slopes.
  Eigen::ArrayXd y_, slope_;
};

}  // namespace contact
