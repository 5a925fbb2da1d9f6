#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "cli/settings/settings.h"

namespace contact::cli {

/// What a shell may offer for a word.
struct Candidate {
  std::string text;
  std::string about;
};
using Candidates = std::vector<Candidate>;

/// A command line up to the word that is completed.
struct Line {
  CLI::App* command = nullptr;
  std::vector<std::string> positionals;
  CLI::Option* open = nullptr;  ///< The flag whose value comes next.
};

/// What stands for the value of an option in its help, such as JOB or FILE.
std::string KindOf(const CLI::Option& option);

/// The values that an option may have here, as far as they can be told.
Candidates Values(const CLI::Option& option, const Settings& settings, const Line& line);

/// The fields of the scenario that the line names, or of any; with `=`, the words of one of them.
Candidates Assignments(const Line& line, const std::string& word);

}  // namespace contact::cli
