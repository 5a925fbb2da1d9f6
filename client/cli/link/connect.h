#pragma once

#include "cli/link/client.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// A connection to the server of the settings. Throws Failure (kUsage) if its name is no address.
inline Client Connect(const Settings& settings) {
  return {settings.server, settings.CallTimeout()};
}

}  // namespace contact::cli
