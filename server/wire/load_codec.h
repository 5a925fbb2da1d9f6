#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/body_codec.h"
#include "wire/rules.h"

namespace contact {

/// Notes that forces do not move `body` if it is fixed; kNone breaks nothing.
void RequireMovable(const std::vector<Body>& bodies, int body, const Rules& rules);

/// Checks the loads and reads them, in pieces that are smooth in time.
std::vector<Load> DecodeLoads(const v1::Scenario& message, const std::vector<Body>& bodies,
                              const BodyNames& names, std::vector<Violation>* violations);

}  // namespace contact
