#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/clusters/flight.h"
#include "simulation/course/course.h"
#include "simulation/course/cycle_samples.h"
#include "simulation/course/turns.h"

namespace contact {

/// The recorded steps of some bodies: where each is, and what presses them.
struct Trace {
  /// A body at both ends of a step.
  struct Ends {
    Place from, to;
    double from_acceleration = 0, to_acceleration = 0;  ///< ẍ [m/s²].
  };
  /// A contact in touch during a step.
  struct Pressed {
    int contact = 0;   ///< Index in Scenario::contacts.
    double mu = 0;     ///< μ of its cycle [N·s/mᵖ⁺¹].
    double yield = 0;  ///< δ_y of its table [m].
  };
  /// What was lost and done from the begin of all to the end of a step.
  struct Exchange {
    double dissipated = 0;                ///< In contacts and supports [J].
    double work = 0;                      ///< By loads and drives [J],
    double from_power = 0, to_power = 0;  ///< and its rate at both ends of the step [W].
  };

  std::size_t bodies = 0;
  std::vector<StepTime> steps;
  std::vector<Ends> ends;            ///< Of each body in each step, step after step.
  std::vector<Exchange> exchanged;   ///< In each step.
  std::vector<Pressed> pressed;      ///< In each step, step after step,
  std::vector<std::size_t> presses;  ///< up to here.
  std::vector<CycleSample> samples;  ///< Those that its cycles want, in the order of time.
  std::vector<Turn> turns;           ///< Of the channels of the whole, in the order of time.

  /// The step in which an instant lies [s], the earlier one at an end.
  std::size_t StepAt(double instant) const;
  /// A body at an instant of a step, by the quintic through both ends; in the clock of the step,
  /// by which it is smooth.
  Place At(std::size_t body, std::size_t step, double instant) const;
  /// Work of loads and drives from the begin of all to an instant of a step [J], by the cubic
  /// through both ends.
  double WorkAt(std::size_t step, double instant) const;
  /// What is in touch in a step.
  std::span<const Pressed> PressedIn(std::size_t step) const;
};

/// Writes the trace of a recording. A step in which samples are taken is written in parts, from
/// one to the next, so that they are as exact as the dense output of its method.
class TraceWriter final : public Recording {
 public:
  /// `bodies` and `contacts`: the indices in the whole scenario of those of `motion`. All outlive
  /// the writer.
  TraceWriter(const Scenario& whole, Motion& motion, const std::vector<int>& bodies,
              const std::vector<int>& contacts, Trace* trace);

  /// The next stretch begins with these displacements since t = 0 [m].
  void Begin(const std::vector<Place>& places);

  void OnStep(const StepTime& step) override;
  void Hold() override;
  void Release() override {}
  void TakeBack() override;

 private:
  /// Where samples and turns lie within a step: θ, ascending.
  void FindParts(const StepTime& step);
  void Write(const StepTime& step, const Eigen::ArrayXd& y0, const Eigen::ArrayXd& slope0,
             const Eigen::ArrayXd& y1, const Eigen::ArrayXd& slope1);

  Motion& motion_;
  const std::vector<int>& contacts_;
  const Scenario& whole_;
  Trace& trace_;
  TurnFinder turn_finder_;
  std::vector<double> base_;  // u at the begin of the stretch [m].
  double lost_before_ = 0;    // Of cycles that run where the trace begins, until then [J].
  // Scratch.
  std::vector<CycleSample> found_;
  std::vector<Turn> turns_;
  std::vector<double> parts_;
  Eigen::ArrayXd from_, from_slope_, to_, to_slope_;
  std::size_t held_ = 0, held_samples_ = 0, held_turns_ = 0;
};

}  // namespace contact
