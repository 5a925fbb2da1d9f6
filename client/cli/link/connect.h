#pragma once

#include "cli/link/client.h"
#include "cli/link/credentials.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// A client of the server that the settings name, with their time limit for calls. Connects in the
/// background. Throws Failure (kUsage) if the name is no HOST:PORT, and as CredentialsOf.
inline Client Connect(const Settings& settings) {
  return {settings.server, settings.CallTimeout(), CredentialsOf(settings)};
}

}  // namespace contact::cli
