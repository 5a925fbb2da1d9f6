#pragma once

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"

namespace contact {

/// Checks the law of a contact and reads it: all but what touches what, and where. A stiffness that
/// follows from materials is left out.
Contact DecodeContactLaw(const v1::Contact& message, const Rules& rules);

}  // namespace contact
