#pragma once

#include <string>
#include <vector>

#include "testing/cases.h"

namespace contact::testing {

/// What no run may break, whatever the search believed: bounds of the contract's promises.
struct Promised {
  double restitution = 2e-8;  ///< |ε_out/ε_in − 1| of a CONVERGED group of a FULL run.
  double identity = 1e-7;     ///< Largest residual of (W4) of a FULL run.
  double balance = 1e-8;      ///< Residuals of (B1) and (B2).
  double negligible = 1e-9;   ///< Of the largest W_c of the run: what may be UNFINISHED inside it.
  double glue = 1e5;          ///< μ of an UNFINISHED group over that of a blow as hard as it felt.
};

/// A few words for each promise that the ledger of a run breaks; empty: none. A run that ended
/// early is judged by what it recorded.
std::vector<std::string> BrokenPromises(const Scenario& scenario, const Record& run,
                                        const Promised& promised = {});

/// m_e of a contact [kg], (M5).
double EffectiveMass(const Scenario& scenario, const Contact& contact);

/// |ε_out/ε_in − 1| of a group by its recorded works; NaN if they give no real ε.
double MissOf(const Group& group);

/// Whether the run gives (G1) of the group: it is CONVERGED, and the end of the run does not cut
/// it.
bool IsAnswered(const Group& group);

}  // namespace contact::testing
