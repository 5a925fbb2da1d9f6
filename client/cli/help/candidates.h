#pragma once

#include <string>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// What a shell may offer for a word.
struct Candidate {
  std::string text;   ///< The word.
  std::string about;  ///< What it is; may be empty.
};
using Candidates = std::vector<Candidate>;

/// The words that stand before the one that is completed. Its pointers are into the parser.
struct TypedWords {
  CLI::App* command = nullptr;           ///< The innermost command that they name.
  std::vector<std::string> positionals;  ///< Words that are neither commands, flags nor values.
  CLI::Option* open = nullptr;           ///< The flag whose value comes next; null: none.
};

/// The values that `option` may have after these words, by its kind. Asks the server for those of
/// a job. Empty if they cannot be told.
Candidates Values(const CommandLine& line, const CLI::Option& option, const TypedWords& typed);

/// The fields that --set may name in the scenario file among the words, or in any scenario if there
/// is no file that can be read. After `=` in `word` the words that the field may be set to.
Candidates Assignments(const TypedWords& typed, const std::string& word);

}  // namespace contact::cli
