#pragma once

#include <limits>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Observed order p of convergence, of a quantity at the steps h r², h r and h with r = `ratio` >
/// 1:
///   p = ln |(f₁ − f₂)/(f₂ − f₃)| / ln r.                                                 (V1)
/// NaN if two neighbours are equal.
double ObservedOrder(double coarse, double middle, double fine, double ratio);

/// The quantity at the step 0, by Richardson's extrapolation with the order p > 0:
///   f = f₃ + (f₃ − f₂)/(rᵖ − 1).                                                         (V2)
double Richardson(double middle, double fine, double ratio, double order);

/// What one quantity at three steps tells of its value at the step 0.
struct Refinement {
  /// The observed order; NaN if a difference is at the floor, or the values go to and fro.
  double order = std::numeric_limits<double>::quiet_NaN();
  /// The value at the step 0: Richardson's with `order`, or the finest where that is at the floor
  /// already, or the values do not settle.
  double limit = 0;
  /// False if the values neither approach a limit from one side, each closer than the one before,
  /// nor agree to the floor: then nothing tells how far the finest is from it.
  bool settles = false;
};

/// Steps are those of ObservedOrder. Differences of at most `floor` ≥ 0 are no differences.
Refinement Refine(double coarse, double middle, double fine, double ratio, double floor);

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
