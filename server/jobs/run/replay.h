#pragma once

#include <cstdint>
#include <string>

namespace contact {

class RunControl;
class RunRecorder;
class Store;

/// Hands to `recorder`, from the log of a job, what the attempt that made its checkpoint has
/// recorded before it, whose last event is `sequence`. Waits for the store; ends early when the run
/// is asked to stop. False: not all of it can be read.
bool Replay(Store& store, const std::string& job, std::uint64_t sequence, RunControl& control,
            RunRecorder& recorder);

}  // namespace contact
