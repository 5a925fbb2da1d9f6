#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"
#include "wire/scenario/body_codec.h"

namespace contact {

/// Notes that forces do not move the body with this index if it is fixed or has a motion. kNone
/// breaks no rule.
void RequireMovable(const v1::Scenario& message, int body, const Rules& rules);

/// Checks the loads of a scenario and reads them, in pieces that are smooth in time: a table gives
/// one for each interval, the gravity of every body one for each body that moves.
std::vector<Load> DecodeLoads(const v1::Scenario& message, const std::vector<Body>& bodies,
                              const BodyNames& names, std::vector<Violation>* violations);

}  // namespace contact
