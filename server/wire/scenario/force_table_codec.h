#pragma once

#include "contact/v1/force_table.pb.h"
#include "simulation/laws/force_table.h"
#include "wire/rules/rules.h"

namespace contact {

/// Reads the table of a contact. Empty if it breaks rules, which are noted.
ForceTable DecodeForceTable(const v1::ForceTable& message, const Rules& rules);

}  // namespace contact
