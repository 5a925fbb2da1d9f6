#pragma once

#include <string>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// Writes the manual pages as sources of scdoc into `folder`, which must exist: contactctl(1), one
/// page for each of its commands, contact-scenario(5), and contactd(8) from what `contactd --help`
/// prints. `contactd` is the path of that program. Throws Failure (kLocal) if the program fails or
/// a page cannot be written.
void WriteManual(const CommandLine& line, const std::string& folder, const std::string& contactd);

}  // namespace contact::cli
