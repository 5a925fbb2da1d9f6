#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/motion/cycle_host.h"
#include "simulation/motion/moving_system.h"
#include "simulation/motion/rest.h"
#include "simulation/motion/step_events.h"

namespace contact {

/// Takes the contacts through their cycles: their begin, their turn, their end.
class Cycles {
 public:
  /// The system must outlive the cycles.
  explicit Cycles(MovingSystem& system);

  /// The system is at a new State.
  void Begin();
  /// Whether a cycle runs, and whether one wants to start.
  bool Run() const;
  bool Wait() const;
  /// Begins the cycles of all contacts that are starting, or of those among them that rest.
  void Start(CycleHost& host, bool resting_only);
  /// Ends the compression of a contact at `time`, where the state is y.
  void Turn(int contact, double time, const Eigen::ArrayXd& y);
  /// The tangents are at the turn of a contact now.
  void KeepTurnGradient(int contact);
  /// Changes the phase of the contact whose event the step has ended on.
  void Apply(const StepEvents::Found& found, CycleHost& host);
  /// Ends the rest of contacts that the step has shown to be disturbed, or at whose end a load has
  /// begun or ended.
  void WakeDisturbed(bool at_breakpoint, CycleHost& host);
  /// Looks at the step, which is accepted, for instants at which rests may end.
  void FollowRests() { rest_.Follow(); }
  /// Asks how long the contacts that rest go on to; ends the rest of those that do not.
  void AskRests(CycleHost& host);
  /// The next instant at which a rest is known to end [s].
  double NextWake() const { return rest_.NextEnd(); }

 private:
  /// Begins NIRV cycles of what touches the bodies of a collision at rest.
  void StartPushed(int collision, CycleHost& host);
  /// Begins the cycle of a contact whose kind is set.
  void StartCycle(int contact, CycleHost& host);
  /// What is known of a cycle as it starts.
  void DescribeStart(int contact);
  /// F_e where the cycle of a contact starts [N]; the slopes do not have its own force yet.
  double ExternalForce(int contact) const;
  /// The works of a contact are counted from this instant on.
  void ResetWorks(int contact);
  /// A contact turns whose force goes back on another way.
  void Yield(int contact);
  /// Sets the scales of a cycle that starts.
  void SetScale(int contact, const CycleHost::Factor& factor);
  /// Makes the scales at least those of a swing by a small part of δ_s.
  void RaiseScale(int contact);
  /// A first step for a cycle [s]: a small part of its duration.
  double FirstStep(int contact) const;
  /// The duration of a cycle that starts [s], from its scales; 0: they are unknown.
  double ExpectedDuration(int contact) const;
  /// Ends the rest of a contact.
  void Wake(int contact, CycleHost& host);
  /// Whether a contact that rested is let go where its cycle starts, and what becomes of it then.
  bool IsLetGo(int contact) const;
  double ForceOfWaiting(int contact) const;
  void Release(int contact, CycleHost& host);
  /// Ends the cycle of a contact at this instant.
  void EndCycle(ContactState& state, Cycle::End end, CycleHost& host);
  /// What is known of a rest as it ends.
  void DescribeRest(ContactState& state);
  /// What is known of a cycle as it ends.
  void DescribeEnd(ContactState& state);
  /// Residual and losses of a cycle; `split_velocity`: δ̇ where its compression has ended [m/s].
  void Balance(ContactState& state, double split_velocity);
  /// Takes back a cycle that has no duration or did no work.
  void CancelCycle(ContactState& state, CycleHost& host);
  /// Changes the sensitivities where a force begins (sign 1) or ends (−1) with a jump, (S3).
  void ShiftAtJump(int contact, double sign);

  MovingSystem& system_;
  Rest rest_;
  // ∂W/∂μ of each contact at the turn of its running cycle.
  std::vector<Eigen::ArrayXd> turn_gradient_;
};

}  // namespace contact
