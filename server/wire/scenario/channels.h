#pragma once

#include <cstddef>
#include <vector>

#include "contact/v1/event.pb.h"
#include "simulation/model/scenario.h"

namespace contact {

/// The columns of the scenario's frame chunks, without values, in the order of Samples.
std::vector<v1::FrameChunk::Column> Channels(const Scenario& scenario);

/// How many of these, the first, are all that older servers have recorded: `time`, and those of
/// bodies and contacts but for accelerations.
std::size_t FirstChannels(const Scenario& scenario);

}  // namespace contact
