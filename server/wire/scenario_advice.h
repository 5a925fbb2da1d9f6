#pragma once

#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/sweep_codec.h"

namespace contact {

/// What about a scenario that breaks no rule will probably not show what its author wants. In the
/// form of violations, so that it is told at the same places. The one place where it is found:
/// server and command line both call it.

/// Of time: steps and samples that are too few for a contact, steps that are too many.
std::vector<Violation> AdviseOnTime(const Scenario& scenario);

/// Of laws and corrections that do not deliver the low restitution asked for. A run tells itself of
/// cycles that miss, so that a result needs this not.
std::vector<Violation> AdviseOnLaws(const v1::Scenario& message);

/// Both; `scenario` is what `message` was decoded to.
std::vector<Violation> Advise(const v1::Scenario& message, const Scenario& scenario);

/// The same for the base of a sweep, by its first cell: but for fields that axes set, and for
/// samples if it keeps no trajectory.
std::vector<Violation> AdviseOnTime(const v1::Sweep& sweep, const DecodedSweep& plan);
std::vector<Violation> Advise(const v1::Sweep& sweep, const DecodedSweep& plan);

/// `field: description — hint`.
std::string Text(const Violation& advice);

}  // namespace contact
