#pragma once

#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {

/// Advice names settings of a scenario that break no rule but will probably not show what its
/// author wants. It has the form of violations, so that it can be shown at the same places. Server
/// and command line both call these functions.

/// Advice on times: too few steps or samples in a contact, too many steps in the run.
std::vector<Violation> AdviseOnTime(const Scenario& scenario);

/// Advice on laws and updates that do not deliver a low restitution, and on scopes that do not let
/// groups grow. A run already tells of cycles that miss their restitution, so results do not repeat
/// this advice.
std::vector<Violation> AdviseOnLaws(const v1::Scenario& message);

/// Advice on neighbours that meet without a contact between them, as far as velocities, supports
/// and loads tell. What happened is told by AdviseOnResult.
std::vector<Violation> AdviseOnPlaces(const Scenario& scenario);

/// Advice on bodies that stand at equilibrium, and could stand elsewhere, too.
std::vector<Violation> AdviseOnStart(const Scenario& scenario);

/// Advice on the contact whose first meeting goes deepest for the radius of a sphere, if it goes
/// deeper than that. `scenario` is what `message` was decoded to, without violations.
std::vector<Violation> AdviseOnDepth(const v1::Scenario& message, const Scenario& scenario);

/// All advice on a scenario. `scenario` is what `message` was decoded to, without violations.
std::vector<Violation> Advise(const v1::Scenario& message, const Scenario& scenario);

/// Advice on times for the base of a sweep, judged by the first cell of `plan`; paths begin at the
/// sweep. Leaves out fields that axes set, and samples if no trajectory is kept.
std::vector<Violation> AdviseOnTime(const v1::Sweep& sweep, const DecodedSweep& plan);

/// All advice on a sweep, with the same omissions. `plan` is what `sweep` was decoded to, without
/// violations.
std::vector<Violation> Advise(const v1::Sweep& sweep, const DecodedSweep& plan);

/// The advice as one line: `field: description — hint`.
std::string Text(const Violation& advice);

}  // namespace contact
