#pragma once

#include <csignal>

#include "config.h"

namespace contact {

/// Starts workers by what waits in the database, until one of the signals comes, which are blocked.
/// Returns the exit code.
int RunLauncher(const Config& config, const sigset_t& signals);

}  // namespace contact
