#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "storage/records.h"

namespace contact {

class RunControl;
class RunRecorder;
class Store;

/// Calls `take` with each stored event of the kinds of `query`, after its position and up to the
/// sequence `end`, until `take` answers false. Waits for the store; ends early when the run is
/// asked to stop. False: `take` has answered so, or the store cannot read.
bool ForEachEvent(Store& store, EventQuery query, std::uint64_t end, RunControl& control,
                  const std::function<bool(const StoredEvent&)>& take);

/// Hands to `recorder`, from the log of a job, what the attempt that made its checkpoint has
/// recorded before it, whose last event is `sequence`. Waits for the store; ends early when the run
/// is asked to stop. False: it has not handed over all of it, so that the run cannot go on from the
/// checkpoint.
bool Replay(Store& store, const std::string& job, std::uint64_t sequence, RunControl& control,
            RunRecorder& recorder);

}  // namespace contact
