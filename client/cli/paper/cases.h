#pragma once

#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// The scenarios of the paper, and the ways in which it solves them.

/// The paper's 6.1: three balls in a row, the first with `velocity` [m/s]. The other two arguments
/// are the energy restitution coefficients of the two contacts.
v1::Scenario TripleChain(double restitution12, double restitution23, double velocity = 0.2);

/// The paper's 6.2: a ball on a spring, pushed against a wall by 500 + 250 sin(2000 t) N.
v1::Scenario SpringWall();

/// The paper's section 3, once for each restitution: a ball of 0.5 kg at kStudyVelocity against a
/// wall of kStudyStiffness. The contact of restitution i is named `i`. Records the ledger only.
v1::Scenario Collisions(const std::vector<double>& restitutions, v1::Contact::Damping damping);

/// Speed of the balls of section 3 [m/s].
inline constexpr double kStudyVelocity = 0.5;
/// Stiffness of their contacts [N/m^1.5].
inline constexpr double kStudyStiffness = 2.41e10;

/// Makes a scenario be solved by the process of the paper: Runge-Kutta with steps of 1 µs, this
/// update of μ, and `tolerance` (the paper's ξ) for the restitution, relative.
void SolveAsPaper(v1::Scenario* scenario, v1::Solver::Update update, double tolerance);

/// Splits the phases of a cycle at the largest force, as the paper's Table 2 does. A scenario whose
/// μ is iterated needs SolveAsPaper, too.
void SplitAtPeakForce(v1::Scenario* scenario);

/// Gives every contact this law, this restitution, and the velocity [m/s] of which the law makes μ.
void UseLaw(v1::Scenario* scenario, v1::Contact::Damping damping, double restitution,
            double velocity);

/// Makes the first μ of every contact of this velocity [m/s], as 6.1 does.
void UseReferenceVelocity(v1::Scenario* scenario, double velocity);

/// Makes a scenario record no trajectory.
void RecordLedgerOnly(v1::Scenario* scenario);

}  // namespace contact::cli
