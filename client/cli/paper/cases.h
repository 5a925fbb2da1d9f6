#pragma once

#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// The paper's 6.1: three balls, the first at `velocity`. ε of each contact; ξ 1e-8.
v1::Scenario TripleChain(double restitution12, double restitution23, double velocity = 0.2);

/// The paper's 6.2: a ball on a spring, pushed against a wall by 500 + 250 sin(2000 t) N.
v1::Scenario SpringWall();

/// The case of the paper's section 3, once for each ε: 0.5 kg at 0.5 m/s against a wall with
/// k = 2.41e10. Contact i is named `i`.
v1::Scenario Collisions(const std::vector<double>& restitutions, v1::Contact::Damping damping);

inline constexpr double kStudyVelocity = 0.5;       ///< [m/s].
inline constexpr double kStudyStiffness = 2.41e10;  ///< [N/m^1.5].

/// Has a scenario solved by the paper's own process, to its tolerance ξ.
void SolveAsPaper(v1::Scenario* scenario, v1::Solver::Update update, double tolerance);

/// Splits the phases at the largest force, as the paper's Table 2 does. A scenario whose contacts
/// are iterated must be solved as in the paper.
void SplitAtPeakForce(v1::Scenario* scenario);

/// Gives every contact this law, ε, and the velocity from which it makes μ.
void UseLaw(v1::Scenario* scenario, v1::Contact::Damping damping, double restitution,
            double velocity);

/// The first approach velocity, 0.2 m/s, makes the first μ of both contacts, as in 6.1.
void UseReferenceVelocity(v1::Scenario* scenario, double velocity);

/// Records no trajectory.
void RecordLedgerOnly(v1::Scenario* scenario);

}  // namespace contact::cli
