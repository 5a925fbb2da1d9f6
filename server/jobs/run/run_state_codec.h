#pragma once

#include <optional>
#include <string>

#include "simulation/episode/run_state.h"

namespace contact {

/// The bytes of a checkpoint: exact, and for the same build of the program only, because another
/// one may compute differently from there on.
std::string EncodeRunState(const RunState& state);

/// Nothing if the bytes are of another build, or none of EncodeRunState.
std::optional<RunState> DecodeRunState(const std::string& bytes);

}  // namespace contact
