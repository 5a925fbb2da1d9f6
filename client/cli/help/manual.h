#pragma once

#include <CLI/App.hpp>
#include <string>

namespace contact::cli {

/// Writes the manual pages as sources of scdoc into `folder`: contactctl(1), one page for each of
/// its commands, contact-scenario(5), and contactd(8) from what `contactd --help` prints. Throws
/// Failure (kLocal) where that cannot be done.
void WriteManual(CLI::App& app, const std::string& folder, const std::string& contactd);

}  // namespace contact::cli
