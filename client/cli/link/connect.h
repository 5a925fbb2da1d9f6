#pragma once

#include "cli/link/client.h"
#include "cli/link/credentials.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// A client of the server that the settings name, with their time limit for calls. Connects in the
/// background. Throws Failure (kUsage) if the name is no HOST:PORT, and as CredentialsOf. Answers
/// that become JSON come as they were sent, because JSON escapes what steers a terminal.
inline Client Connect(const Settings& settings) {
  const bool json = settings.output == OutputFormat::kJson;
  return {settings.server, settings.CallTimeout(), CredentialsOf(settings),
          json ? Client::Answers::kAsSent : Client::Answers::kPrintable};
}

}  // namespace contact::cli
