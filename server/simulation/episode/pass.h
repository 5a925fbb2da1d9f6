#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "simulation/episode/membership.h"
#include "simulation/model/observer.h"

namespace contact {

/// Later than any end [s]; more than any miss.
inline constexpr double kForever = 1e300;

/// One pass through the motion with the μ of the groups, and what it shows of them.
class Pass final : public CycleHost {
 public:
  /// What a pass is to see.
  struct Plan {
    double tolerance = 0;             ///< Relative, of the integration; 0: the scenario's.
    double end = 0;                   ///< Of the run: what begins later is no matter of the search.
    double far = kNever;              ///< So far beyond that end it follows a few cycles only [s].
    double until = kForever;          ///< It goes no further [s].
    int most_cycles = 1;              ///< It ends when so many have begun.
    const Sight* before = nullptr;    ///< What led to its start, if that is not the episode's.
    bool first_quiet = false;         ///< It ends at the first instant at which no cycle runs.
    double guess_from = kNever;       ///< What begins no earlier is guessed anew, if it was [s].
    bool patient = false;             ///< It goes on where nothing turns.
    bool retries = true;              ///< It may end because a rest should have ended earlier.
    bool sensitive = false;           ///< It differentiates by the μ of the block,
    bool wide = false;                ///< or of all groups.
    double to_miss = 0;               ///< It goes on to a group that misses by more; 0: it ends
                                      ///< where all of the block has ended.
    double block_until = kForever;    ///< So far for a block that does not end [s].
    std::vector<GroupId> block = {};  ///< Groups to be seen to their ends.
  };

  Pass(const Scenario& scenario, Motion& motion, Observer& observer, Groups& groups);

  /// Passes from `start`, at the latest until the contacts are open.
  Sight Look(const State& start, const Plan& plan, const std::stop_token& stop,
             std::int64_t step_limit);

  /// Whether no contact is about to begin a cycle.
  bool IsOpen() const;

  Factor OnStart(ContactState& state, double effective_mass, double external_force) override;
  void OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
             const Eigen::ArrayXd& restitution_gradient, double length, double speed) override;
  void OnCancel(ContactState& state) override;
  double OnRelease(ContactState& state, double effective_mass) override;
  double RestEnds(const ContactState& state) override;
  bool OnDisturbed(const ContactState& state, double cause) override;
  bool OnStep() override;

 private:
  void Continue(const Sight& before);
  bool Counts(const Cycle& cycle) const;
  bool Matters(const Unknown& unknown) const;
  GroupSight* Seen(const ContactState& state);
  bool WantsColumn(const GroupId& id) const;
  void Measure(GroupSight& group) const;
  void Stir(double time);
  double SlowestTurn() const;
  bool Creeps() const;
  bool SeesFar() const;
  bool Enough() const;
  bool IsLong() const;
  bool BlockHasEnded() const;
  bool ShowsMiss() const;

  const Scenario& scenario_;
  Motion& motion_;
  Observer& observer_;
  Groups& groups_;
  Membership membership_;
  Plan plan_;
  Sight sight_;
  int cycles_ = 0;   // Begun,
  int running_ = 0;  // and groups that run, of those that matter.
  int columns_ = 0;
  int late_cycles_ = 0;        // Begun after the end of the run,
  int most_late_;              // of which so many are followed far beyond it.
  double idle_since_ = 0;      // When a cycle began or ended last [s],
  int idle_steps_ = 0;         // and steps since then.
  double longest_period_ = 0;  // Of the sines among loads and drives [s].
  bool enough_ = false;
};

}  // namespace contact
