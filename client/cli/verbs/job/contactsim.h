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

/// The file of a figure, for verbs that contactsim draws for. All throw Failure (kUsage) for an
/// ending or a format of no figure.

/// The format of a figure by the ending of its file, svg without ending.
OutputFormat FormatOfFigure(const std::string& path);

/// The words that tell contactsim where to draw and how: `file`, or, if that is empty, `name` with
/// the ending of the format that -o names. A txt figure without a file is printed, as wide as the
/// terminal. Throws Failure (kLocal) if the file cannot be written.
std::vector<std::string> FigureWords(const std::string& file, const std::string& name,
                                     const Settings& settings);

}  // namespace contact::cli
