#pragma once

#include "simulation/model/scenario.h"
#include "simulation/motion/state.h"

namespace contact {

/// Writes into the cycle of `state`, whose δ_s is known, the works of its compression: (W1) to
/// (W3).
///
/// `deformation` [m] is δ where the compression ends. `work` W and `external_work` E [J] are those
/// from the start of the cycle to there.
void SetCompression(const Contact& contact, double deformation, double work, double external_work,
                    ContactState* state);

/// Writes into the cycle of `state`, whose compression and δ_o are known, the works of its
/// restitution: (W1) to (W3).
///
/// `deformation` [m] is δ where the restitution begins. `work` W and `external_work` E [J] are
/// those from the start of the cycle to its end.
void SetRestitution(const Contact& contact, double deformation, double work, double external_work,
                    ContactState* state);

/// Writes into the cycle of `state`, whose δ_s is known, what a rest has come to that ends at
/// `time` [s]: the sum of its works, in the phase that the sign of W gives.
void SetRest(const Contact& contact, double time, double deformation, double work,
             double external_work, ContactState* state);

}  // namespace contact
