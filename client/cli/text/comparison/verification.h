#pragma once

#include <string>
#include <vector>

#include "cli/text/comparison/refinement.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The three steps, or tolerances, at which a job is run again to see how its numbers depend on
/// them.
struct RefinementPlan {
  /// True: relative tolerances of the adaptive method; false: fixed steps [s].
  bool adaptive = false;
  /// From one to the next: 2 of steps, 10 of tolerances.
  double ratio = 2;
  /// That of the job.
  double own = 0;
  /// Those of the three runs, coarse to fine.
  std::vector<double> resolutions = {};
  /// The order that the method has in the scenario; 0: an adaptive method promises none. That of
  /// RK4 is 4 where contact forces are smooth, and q + 1 where one begins as δ^q or δ^q δ̇ with a q
  /// that is no whole number: 2.5 of Hertz contacts.
  double order = 0;
  /// How exactly the job solves μ, its restitution_tolerance ξ.
  double claim = 0;

  /// The field of the scenario that is refined: `solver.step_s` or `solver.relative_tolerance`.
  std::string Field() const;
  /// The scenario at one of the resolutions. Its ξ is a thousandth, so that little but the step is
  /// left to see, and as many more steps are allowed as there will be.
  v1::Scenario At(double resolution, v1::Scenario scenario) const;
};

/// The plan for a scenario that breaks no rule: the step halved three times, or the tolerance
/// divided by ten three times; or the three smallest tolerances that the contract allows, where
/// that would be less.
RefinementPlan PlanOf(const v1::Scenario& scenario);

/// What the numbers of a job are at finer steps, and how far off its own are.
struct Verification {
  /// One quantity.
  struct Number {
    /// Such as `B1-B2 #1 μ`.
    std::string name;
    std::string unit;
    /// That of the job.
    double own = 0;
    /// Those of the three runs.
    std::vector<double> values = {};
    Refinement refinement = {};
    /// How far the job is from the value at the step 0; where the values do not settle, from the
    /// farther of the finest two. Relative to `scale`.
    double distance = 0;
    /// The largest speed, the largest force of the contact, or μ.
    double scale = 1;
    /// What `distance` may be.
    double allowed = 0;

    bool Holds() const { return distance <= allowed; }
  };

  RefinementPlan plan;
  v1::Job job;
  /// In the order of plan.resolutions.
  std::vector<v1::Job> runs = {};
  /// Numbers that job and runs have: final velocities; peak force and μ of each cycle.
  std::vector<Number> numbers = {};
  /// What is not the same in job and runs, such as the number of cycles of a contact.
  std::vector<std::string> differences = {};
  /// What errors may be, relative to the largest speed or the largest force of a contact.
  double tolerance = 0;

  /// True if the job is as close to the values at the step 0 as allowed, in all numbers.
  bool Holds() const;
  /// True if the observed order of the number is that of the plan, to ±0.5.
  bool ShowsOrder(const Number& number) const;
};

/// Compares a job with its runs of `plan`; all have ended. `tolerance` is > 0. An error of the
/// tolerance in ε is one of 1/(1 − ε) times it in μ; so much is allowed there, and in weak cycles
/// more, by their part of the largest force of their contact. Peak forces, which are read off
/// between steps, may be off by ten times the tolerance.
Verification Verify(const RefinementPlan& plan, v1::Job job, std::vector<v1::Job> runs,
                    double tolerance);

}  // namespace contact::cli
