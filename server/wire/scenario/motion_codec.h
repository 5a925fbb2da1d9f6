#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"

namespace contact {

/// Checks a prescribed motion and reads it, in pieces that are smooth in time and the first of
/// which begins at 0; `origin` [m] is the position from which it counts. Empty if it breaks rules.
/// Drive::body is left to the caller.
std::vector<Drive> DecodeMotion(const v1::Motion& motion, double origin, const Rules& rules);

/// Gives a body that moves as `pieces` say what it has at t = 0, and adds them to the drives as
/// those of the body with this index.
void AddMotion(std::vector<Drive> pieces, int index, Body* body, std::vector<Drive>* drives);

}  // namespace contact
