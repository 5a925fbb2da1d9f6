#pragma once

#include "launcher/demand.h"
#include "launcher/launcher_options.h"

namespace contact::launcher {

/// How many worker processes there should be: a thread for each job that waits or runs, and for
/// each cell of a sweep that runs, within the limits.
///
/// Jobs that run count, because their threads are not free for those that wait.
int Wanted(const Demand& demand, const Limits& limits);

}  // namespace contact::launcher
