// An independent integration of a run: the plain equations of motion with the μ and the instants
// that the ledger tells. What the ledger says must come out again.
#pragma once

#include <string>
#include <utility>

#include "testing/cases.h"

namespace contact::testing {

/// How far the ledger of a run is from what an independent method finds, relative. Of times: the
/// rest of the speed that shall be 0 there, or of the deformation, over the largest of the cycle.
/// A NIRV cycle shall begin with δ̇ = 0; after a rest with no more than may settle.
struct Disagreement {
  double velocity = 0;     ///< Of the bodies at the end, over the largest speed.
  double restitution = 0;  ///< Of the groups that are CONVERGED or follow a law, and have ended.
  double work = 0;         ///< Of W_c of these groups.
  double time = 0;         ///< Of starts, turns and ends of cycles that did not rest.
  double approach = 0;     ///< Of δ̇⁻ of collisions.
  double rest = 0;         ///< Energy with which NIRV cycles begin, over that of their swing.
  double overlap = 0;      ///< Elastic force outside cycles, over the largest of the contact.
  double law = 0;          ///< Of μ of a named law, by its α and δ̇⁻.
  double worst = 0;        ///< Largest, of which times and overlap count a hundredth, works and
                           ///< δ̇⁻ a tenth.
  double sure = 0;         ///< The same, less what errors of steps as large as the run's may make.
  std::string where;       ///< Where that is: what, and the contact and cycle; empty if it is 0.
  double checked_until = 0;  ///< Where the integration ended [s]: too many steps, or the run's end.
  int steps = 0;             ///< Of the integration.
};

/// Integrates a run that finished again, in `most_steps` at most; what it does not reach is not
/// compared.
Disagreement CompareWithIndependent(const Scenario& scenario, const Record& run,
                                    int most_steps = 300'000);

}  // namespace contact::testing
