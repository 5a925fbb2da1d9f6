#pragma once

#include <cstdint>

#include "simulation/episode/groups.h"
#include "simulation/model/observer.h"

namespace contact {

/// Tells the observer of each correction of μ, and counts them.
class IterationLog {
 public:
  explicit IterationLog(Observer& observer) : observer_(observer) {}

  void Begin(int episode, double start_time);
  /// The pass that a correction starts from.
  void Correct(const Sight& sight);
  /// The pass whose μ are taken,
  void Accept(const Sight& sight);
  /// or the groups of the one that is recorded.
  void Accept(const std::vector<Group>& recorded);
  /// A group has taken in its neighbour.
  void Grow(const Sight& sight, const GroupId& id, const Unknown& unknown);

  int corrections() const { return number_; }  ///< In this episode.
  std::int64_t total = 0;                      ///< Corrections of the run.
  std::int64_t growths = 0, growths_no_progress = 0;

 private:
  void Report(const Sight& sight, bool accepted);

  Observer& observer_;
  int episode_ = 0;
  int number_ = 0;
  double start_time_ = 0;
};

}  // namespace contact
