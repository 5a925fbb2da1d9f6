#pragma once

#include <stop_token>

#include "simulation/model/ledger.h"
#include "simulation/model/observer.h"
#include "simulation/model/scenario.h"

namespace contact {

struct RunState;

/// Solves a scenario from 0 to its end time. A pure function: same scenario, same calls of the
/// observer and same outcome, to the byte.
///
/// Blocks until the run has ended, and calls `observer` on the calling thread. `stop` is looked at
/// in every step, and once in RowsPerChunk samples. How the run ended is in Outcome::end; only
/// exceptions of the observer leave this function.
Outcome Run(const Scenario& scenario, Observer& observer, std::stop_token stop = {});

/// As Run, with all bodies moved together from touch to touch, also where parts of them would do:
/// the dearer way to the same answers.
Outcome RunWhole(const Scenario& scenario, Observer& observer, std::stop_token stop = {});

/// Goes on from a boundary of an earlier run of the same scenario by the same program: calls the
/// observer as that run would have done from there on, and has its outcome, to the byte. Otherwise
/// like Run.
Outcome Resume(const Scenario& scenario, const RunState& from, Observer& observer,
               std::stop_token stop = {});

}  // namespace contact
