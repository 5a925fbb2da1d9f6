#pragma once

#include <CLI/CLI.hpp>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// Adds `token` to `server`: makes, lists and revokes tokens in the file of a server.
void AddToken(CommandLine& line, CLI::App& server);

/// Adds `audit` to `server`: checks the audit log of a server.
void AddAudit(CommandLine& line, CLI::App& server);

/// Makes `login` the command that gets a token from an identity provider.
void AddLogin(CommandLine& line, CLI::App& login);

}  // namespace contact::cli
