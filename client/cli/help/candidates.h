#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// What a shell may offer for a word.
struct Candidate {
  /// The word.
  std::string text;
  /// What it is; may be empty. Shells show the first line.
  std::string about;
};
using Candidates = std::vector<Candidate>;

/// The words that stand before the one that is completed. Its pointers are into the parser.
struct TypedWords {
  /// The innermost command that they name.
  CLI::App* command = nullptr;
  /// Words that are neither commands, flags nor values of flags.
  std::vector<std::string> positionals;
  /// The flag whose value comes next; null: none.
  CLI::Option* open = nullptr;
};

/// The names of the states that a job can have, in the order of the contract.
std::vector<std::string_view> JobStates();

/// The figures and tables of the paper that contactsim can make again.
const std::vector<std::string>& PaperItems();

/// The values that `option` may have after these words, by its kind. Asks the server for those of
/// a job. Empty if they cannot be told.
Candidates Values(const CommandLine& line, const CLI::Option& option, const TypedWords& typed);

/// The fields that --set may name in the scenario file among the words, or in any scenario if there
/// is no file that can be read. After `=` in `word` the words that the field may be set to.
Candidates Assignments(const TypedWords& typed, const std::string& word);

}  // namespace contact::cli
