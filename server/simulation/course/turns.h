#pragma once

#include <span>
#include <vector>

#include "simulation/episode/run_state.h"
#include "simulation/motion/motion.h"

namespace contact {

/// Finds where the channels turn of which a trajectory keeps the extremes between two samples. See
/// Scenario::turning_channels.
class TurnFinder {
 public:
  /// `bodies` and `contacts`: the indices in the whole scenario of those of `motion`. All outlive
  /// the finder.
  TurnFinder(const Scenario& whole, Motion& motion, const std::vector<int>& bodies,
             const std::vector<int>& contacts);

  /// The turns in the step that the motion tells of, in the order of time. `base`: what to add to
  /// the displacement of each of its bodies [m].
  void Find(const StepTime& step, std::span<const double> base, std::vector<Turn>* found);

 private:
  /// Where Ḟ is 0, and where a cycle begins: there F is least, or v changes in a bend.
  void FindForce(const ActiveContact& active);
  /// Where ẋ or ẍ is 0.
  void FindBody(std::ptrdiff_t body, double base);
  /// Ḟ in a state and its slopes [N/s].
  double Growth(const ActiveContact& active, const Eigen::ArrayXd& y,
                const Eigen::ArrayXd& slope) const;
  /// Adds a turn at θ. `value(y)` is that of the channel.
  template <class Value>
  void Add(double theta, int channel, const Value& value);
  /// Adds a turn where `rate(y, slope)` changes its sign in the step, if it does.
  template <class Rate, class Value>
  void AddZero(const Rate& rate, int channel, const Value& value);
  /// The state at θ in y_.
  void GoTo(double theta);

  const Scenario& whole_;
  Motion& motion_;
  const std::vector<int>& bodies_;
  const std::vector<int>& contacts_;
  // Of the step.
  StepTime step_;
  bool prepared_ = false;
  std::vector<Turn>* found_ = nullptr;
  Eigen::ArrayXd y_, slope_;
};

}  // namespace contact
