#pragma once

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"

namespace contact {

/// Reads how the contacts stand at time 0. AT_EQUILIBRIUM moves the bodies of the scenario, of
/// which all else is read and breaks no rule, to where they are in equilibrium; that none is held
/// is a violation.
void DecodeStart(const v1::Scenario& message, const Rules& rules, Scenario* scenario);

}  // namespace contact
