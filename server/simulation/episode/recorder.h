#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulation/episode/membership.h"
#include "simulation/model/observer.h"

namespace contact {

struct RunState;

/// Hosts the passes that are recorded, with the μ found, and writes the ledger.
class Recorder final : public CycleHost {
 public:
  Recorder(const Scenario& scenario, const Motion& motion, Observer& observer, Groups& groups);

  /// A recorded pass of this episode begins: forgets the cycles and groups of the last one.
  /// `repeatable`: it may be made again, and ends where a rest should have ended earlier.
  void Begin(int episode, bool repeatable);
  /// Fills what is known of a cycle that the end of the run has cut.
  void FinishCut(ContactState& state);

  Factor OnStart(ContactState& state, double effective_mass, double external_force) override;
  void OnEnd(ContactState& state, const Eigen::ArrayXd&, const Eigen::ArrayXd&, double,
             double) override;
  double OnRelease(ContactState& state, double effective_mass) override;
  double RestEnds(const ContactState& state) override { return membership_.RestEnd(state); }
  bool OnDisturbed(const ContactState& state, double cause) override;
  void OnCancel(ContactState& state) override;
  bool OnStep() override;

  void Save(RunState* state) const;
  void Restore(const RunState& state);

  /// Whether every group that has ended since Begin is one that the search has answered,
  bool sound() const { return sound_; }
  /// and whether the recorded motion denies what it has found of one.
  bool denies() const { return denies_; }
  /// Says which rows of the last recording, which counts, fail their proof.
  void TellFaults();

  std::vector<Cycle> cycles;  ///< Ended since Begin,
  std::vector<Group> groups;  ///< and the groups that ended with them.

 private:
  void Open(ContactState& state, const Unknown& unknown) const;
  void Label(const ContactState& state, Cycle& cycle) const;
  std::string Fault(const ContactState& state) const;
  void Disprove(ContactState& state, const std::string& fault);
  void Close(ContactState& state);
  void WarnWithoutVelocity(const ContactState& state);
  void WarnOfMiss(const Contact& contact, const Cycle& cycle);

  const Scenario& scenario_;
  const Motion& motion_;
  Observer& observer_;
  Groups& known_;
  Membership membership_;
  int episode_ = 0;
  bool sound_ = true;
  bool denies_ = false;
  bool repeatable_ = false;
  bool disturbed_ = false;
  std::vector<bool> warned_;                         // Per contact.
  std::vector<bool> missed_;                         // Per law.
  std::vector<std::pair<int, std::string>> faults_;  // By contact, since Begin.
  std::vector<bool> unproven_;  // Contacts of which it was told that a row fails its proof.
};

}  // namespace contact
