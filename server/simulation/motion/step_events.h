#pragma once

#include <vector>

#include "simulation/motion/contact_events.h"
#include "simulation/motion/moving_system.h"

namespace contact {

/// Finds what happens to the contacts in the step, one event after the other.
class StepEvents {
 public:
  /// An event, and whose it is: a contact's or a support's. Both kNone: there is none.
  struct Found {
    int contact = kNone;
    ContactEvent event = {};
    int support = kNone;

    bool any() const { return contact != kNone || support != kNone; }
  };

  /// The system must outlive this.
  explicit StepEvents(const MovingSystem& system);

  /// A new step: nothing in it is dealt with.
  void Restart();
  /// The first event of the step that is not dealt with yet. `separating`: the contact whose
  /// separation was to end the step, or kNone.
  Found First(int separating) const;
  /// All events of a contact up to θ are dealt with.
  void Pass(int contact, double theta);

 private:
  /// Deformation of a contact that is to be taken for 0 [m].
  double Noise(int contact) const;
  /// How far a contact would close in the step at the δ̇ with which the step begins [m].
  double Drift(int contact) const;
  /// Takes the first event of a support if it comes before `first`.
  void FindSlips(Found* first) const;

  const MovingSystem& system_;
  // θ up to which each contact's events in the step are dealt with.
  std::vector<double> passed_;
};

}  // namespace contact
