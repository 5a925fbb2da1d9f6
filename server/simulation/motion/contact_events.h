#pragma once

#include <optional>

namespace contact {

/// Where a contact stands in its cycle.
enum class Phase {
  kOpen,         ///< No cycle.
  kStarting,     ///< A cycle begins at this instant; its μ is not chosen yet.
  kCompression,  ///< δ̇ > 0.
  kRestitution,  ///< δ̇ < 0.
  kResting,      ///< Settled: in touch, with motion too weak to be told apart in cycles.
};

/// Whether a contact in this phase may exert a force: its cycle runs, or it rests.
inline bool InTouch(Phase phase) { return phase != Phase::kOpen && phase != Phase::kStarting; }

/// What ends a phase.
enum class EventKind {
  kTouch,          ///< Open, δ rises through 0: a collision begins.
  kRestTouch,      ///< Open, touching at rest, δ begins to rise: a NIRV cycle begins.
  kTurn,           ///< Compression, δ̇ falls through 0.
  kSeparation,     ///< Restitution, δ falls through 0.
  kRelease,        ///< A contact that rested falls apart: a restitution without compression begins.
  kNonSeparation,  ///< Restitution, δ̇ rises through 0 with δ > 0.
  kSlip,           ///< Of a support: its force reaches the largest.
  kStick,          ///< Of a support that slips: its motion turns.
};

/// The end of a contact's phase inside a step.
struct ContactEvent {
  EventKind kind = EventKind::kTouch;
  /// Where in the step the event lies, in [0, 1]; 0: at its start.
  double theta = 0;
};

/// Deformation along a step from θ = 0 to 1: the quintic through value, slope and curvature at
/// both ends.
class DeformationPath {
 public:
  /// δ, dδ/dθ and d²δ/dθ² at an end of the step, all in [m].
  struct End {
    double value, slope, curvature;
  };
  DeformationPath(End from, End to) : DeformationPath(from, to, from.slope) {}
  /// `drift_of_step`: δ̇ at the start times the length of the step [m]. The slope of a path is no
  /// measure of rest, for that of a warped step may begin with 0.
  DeformationPath(End from, End to, double drift_of_step);

  /// δ at θ [m].
  double Value(double theta) const;
  /// dδ/dθ at θ [m].
  double Slope(double theta) const;
  /// True if a contact in this phase plainly has no event between these ends: that of a cycle whose
  /// δ̇ keeps its sign, or an open one that does not come near.
  static bool IsPlain(Phase phase, const End& start, const End& end) {
    if (phase == Phase::kOpen) return end.value <= 0 && !(start.slope > 0 && end.slope < 0);
    const double sign = phase == Phase::kCompression ? 1 : -1;
    const bool ends_in_phase = end.value > 0 && sign * end.slope > 0;
    const bool may_dip = sign * start.curvature < 0 && sign * end.curvature > 0;
    return ends_in_phase && !may_dip;
  }

  /// The ends that the path was made from.
  const End start, end;
  /// How far the contact would close in the step at the δ̇ with which the step begins [m].
  const double drift;

 private:
  /// Coefficients of the powers of θ, from θ⁰ to θ⁵ [m].
  double c_[6];
};

/// The first event of a contact after `from` in a step, if any. It finds crossings between eighths
/// of what is left and, for an open contact, a touch at any peak of δ. An open contact with |δ| and
/// drift up to `noise` [m] touches at rest: nothing below that can be told from round-off.
std::optional<ContactEvent> FirstEvent(Phase phase, const DeformationPath& path, double from = 0,
                                       double noise = 0);

/// The first event of a support whose stretch is this path, if any. It slips beyond ±`most` [m];
/// `side`: whether it does so, as in Slip.
std::optional<ContactEvent> FirstSlip(const DeformationPath& path, double most, int side);

}  // namespace contact
