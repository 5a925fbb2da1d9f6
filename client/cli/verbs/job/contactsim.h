#pragma once

#include <string>
#include <vector>

#include "cli/settings/settings.h"

namespace contact::cli {

/// The Python package contactsim draws what contactctl cannot print: `python3 -m contactsim WORD…`.
/// The environment of that program names server and identity of the settings: no token stands on a
/// command line. Package and program are those beside contactctl, else those that are installed.

/// Its version and that of matplotlib; empty if one of them is not there.
std::string ContactsimVersion();

/// The command that installs what drawing needs.
std::string InstallDrawing();

/// Becomes this program. Throws Failure (kLocal) with the missing Debian package if it is not
/// there.
[[noreturn]] void BecomeContactsim(const std::vector<std::string>& words, const Settings& settings);

/// Runs this program to its end; `input` is what it reads. Throws Failure (kLocal) as above and,
/// with its exit code, if it fails; what it said stands above then.
void RunContactsim(const std::vector<std::string>& words, const Settings& settings,
                   const std::string& input = "");

}  // namespace contact::cli
